// A filter that defines FILTER_PASSES answers in so many passes: filter_pass(pass, ...) sets `visible` and returns filter_done, or tells
// which later pass shall answer. Storages with STORAGE_PASSES serve such filters.
#ifndef SHADEWRIGHT_FILTER_PASSES_GLSL
#define SHADEWRIGHT_FILTER_PASSES_GLSL

const uint filter_done = 0;

#endif
