// Before its first branch a CPU device reads a uniform once for a subgroup, behind one lane by lane, which took half of a look-up's
// time. A shader that defines SHADEWRIGHT_LOADS_FIRST copies what its modules read by load_...() as the first thing it does.
#ifndef SHADEWRIGHT_SHADOW_LOADS_FIRST_GLSL
#define SHADEWRIGHT_SHADOW_LOADS_FIRST_GLSL

// Behind a layout: `name`, a struct in a uniform buffer, and the function that copies it in such a shader.
#ifdef SHADEWRIGHT_LOADS_FIRST
#define SHADEWRIGHT_UNIFORM(type, name, load) \
  uniform name##_block { type name##_uniform; }; \
  type name; \
  void load() { name = name##_uniform; }
#else
#define SHADEWRIGHT_UNIFORM(type, name, load) uniform name##_block { type name; };
#endif

#endif
