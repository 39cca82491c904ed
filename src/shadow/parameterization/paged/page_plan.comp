// Chooses the finest level to draw: the finest asked for, unless the pool can't hold it; then coarser, for everybody. And
// whether the pool is emptied: when its free slots are too few for what is new.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

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
  state.clear.instance_count = 1;

  // Blocks are drawn as one, which is worth some pages that nobody asked for as long as the pool has room (and slots before the
  // first block, which stands on a whole block's place). What was counted holds unless levels were dropped or the pool emptied
  // for want of room.
  const uint worth = 16;
  bool counted = finest == paged.finest && (!flush || paged.flush != 0);
  uint room = paged.pool_pages - state.slots - fresh;
  state.block_least = block_pages + 1;
  if (paged.blocks == 0 || (room < block_pages && state.slots % block_pages != 0)) return;
  state.block_least = block_pages;
  room -= min(room, block_pages - 1);
  for (uint extra = 0; counted && state.block_least > worth; --state.block_least) {
    extra += state.blocks_with[state.block_least - 1] * (block_pages - state.block_least + 1);
    if (extra > room) break;
  }
}
