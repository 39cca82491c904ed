// Chooses the finest level to draw: the finest asked for, unless the pool can't hold it; then coarser, for everybody. And
// whether the pool is emptied: when its free slots are too few for what is new.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/pages.h"

layout(local_size_x = 1) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) buffer StateOut { PageState state; };

void main() {
  uint coarser = 0, fresh = 0;
  for (uint level = paged.finest; level <= paged.top; ++level) {
    coarser += state.requested[level];
    fresh += state.fresh[level];
  }
  uint finest = paged.finest;
  for (;; ++finest) {
    coarser -= state.requested[finest];
    fresh -= state.fresh[finest];
    if (finest == paged.top || state.requested_or_finer[finest] + coarser <= paged.pool_pages) break;
  }
  state.finest = finest;
  state.pages = state.requested_or_finer[finest] + coarser;
  fresh += state.fresh_or_finer[finest];
  bool flush = paged.flush != 0 || state.slots + fresh > paged.pool_pages;
  if (flush) {
    ++state.epoch;
    ++state.flushes;
    state.slots = 0;
    fresh = state.pages;
  }
  state.flushed = flush ? 1 : 0;
  state.first_slot = state.slots;
  state.slots += fresh;
  state.clear_instance_count = 1;
}
