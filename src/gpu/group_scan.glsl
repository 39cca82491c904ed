// Exclusive sums over a work group of 64. The subgroup's size is asked, never assumed.
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

const uint group_size = 64;
shared uint subgroup_sums[group_size];

// The sum of `value` over the invocations before this one, and over all. Reached by all invocations of the group.
uint group_exclusive_sum(uint value, out uint total) {
  uint before = subgroupExclusiveAdd(value);
  barrier();  // earlier sums have been read
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1) subgroup_sums[gl_SubgroupID] = before + value;
  barrier();
  total = 0;
  for (uint i = 0; i < gl_NumSubgroups; ++i) {
    if (i == gl_SubgroupID) before += total;
    total += subgroup_sums[i];
  }
  return before;
}
