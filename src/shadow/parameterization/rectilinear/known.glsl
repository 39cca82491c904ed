// What a technique's analysis is specialized for: a CPU device runs what a condition leaves out, unless it is known when the
// shader is compiled.
layout(constant_id = 1) const uint functions = 0;                // importance_...
layout(constant_id = 2) const uint collapse = collapse_sum;      // or collapse_max
layout(constant_id = 3) const bool two_dimensional = false;      // there is an importance map of map_size
