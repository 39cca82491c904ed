// Structs of paged maps that C++ and GLSL share.
#ifndef SHADEWRIGHT_PAGED_SHARED_H
#define SHADEWRIGHT_PAGED_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
using glm::uvec2;
using glm::uvec3;
#endif

const uint page_texels = 32, max_page_levels = 13;
const uint block_pages = 32;  // 8 x 4 pages: a word of a bitmask
const uint superpage_texels = 1024;

#ifdef __cplusplus
#define SHADEWRIGHT_SHARED inline
#else
#define SHADEWRIGHT_SHARED
#endif

/// Every second bit of x, from the lowest on.
SHADEWRIGHT_SHARED uint z_curve_gather(uint x) {
  x &= 0x55555555u;
  x = (x | x >> 1) & 0x33333333u;
  x = (x | x >> 2) & 0x0f0f0f0fu;
  x = (x | x >> 4) & 0x00ff00ffu;
  return (x | x >> 8) & 0x0000ffffu;
}

/// The place of a level's page by its number.
SHADEWRIGHT_SHARED uvec2 z_curve_place(uint number) {
  return uvec2(z_curve_gather(number), z_curve_gather(number >> 1));
}

/// Number of the first page of the level with 4^k pages. Levels of less than 32 pages have a word each, so that no word
/// has pages of two levels.
SHADEWRIGHT_SHARED uint page_base(uint k) {
  return k < 3u ? 32u * k : 96u + ((1u << 2u * k) - 64u) / 3u;
}

#undef SHADEWRIGHT_SHARED

const uint lod_area = 0, lod_box = 1, lod_axis = 2, lod_bounded = 3;

/// What stays the same during a frame. Level 0 is the finest; level `top` has one page.
struct PagedConstants {
  vec3 pixel_x, pixel_y;  // world step of a pixel at view depth 1
  vec3 view_axis;         // view depth = dot(view_axis, world - eye)
  uint top;
  uint finest;      // levels below are not asked for
  uint coarsest;    // nor those above: where all pages of this one are there, none of them is
  uint faces;       // 1, or 6 of a point light
  uint words;       // of 32 pages, of one face
  uint pool_width;  // pages
  uint pool_pages;
  uint flush;   // 1: nothing kept from earlier frames counts
  uint blocks;  // 1: blocks of pages may be drawn as one
  uint lod;
  uint analysis_scale;    // pixels from one that asks to the next
  float footprint;        // half width of what a filter asks, texels
  uint footprint_levels;  // 1, or 2: the next coarser level too
  float near[6];          // the least w of a caster, by face
};

/// VkDrawIndirectCommand.
struct DrawArrays {
  uint vertex_count;
  uint instance_count;
  uint first_vertex;
  uint first_instance;
};

/// How a pair is drawn. It covers no texel's centre outside of its unit; or it does, but its fragments there are few
/// enough to be thrown away; or it is clipped at the unit's border, which costs several times what drawing does.
const uint pair_inner = 0, pair_small = 1, pair_clipped = 2, pair_kinds = 3;

/// What a frame finds out on the device, and what it keeps for the next.
struct PageState {
  uint finest;       // of the pages drawn: coarser than asked for when the pool is full
  uint pages;        // needed
  uint block_least;  // a block of which so many pages are needed gets all of them
  uint pages_drawn;  // of those, in this frame
  uint flushed;      // 1: nothing of earlier frames was kept
  uint first_slot;   // of what is new in this frame: blocks, then single pages
  uint new_blocks, new_singles;
  uint raw_requests;     // pixels that asked
  uint border_requests;  // of requests=sort: further pages that filters reach
  uint visible_clusters;
  uvec3 bin_groups;  // VkDispatchIndirectCommand
  DrawArrays draws[pair_kinds];
  uint late_clusters;                  // whose triangles did not: the next round draws them
  uint triangles, late_triangles;      // of the clusters of this round, and of the late ones
  uint pairs;                          // drawn in all rounds
  uint taps, coarser_taps, lost_taps;  // of statistics=on: asked, answered by a coarser page, by none
  uint used_texels;
  DrawArrays clear;
  uint requested[max_page_levels];           // pages asked for, by level
  uint requested_or_finer[max_page_levels];  // pages that were asked for or hold one that was
  uint fresh[max_page_levels];               // of each, those without a slot
  uint fresh_or_finer[max_page_levels];
  uint blocks_with[block_pages + 1];  // blocks without any slot, by how many of their pages are asked for
  // Kept from frame to frame.
  uint epoch;  // of the table's entries that count
  uint slots;  // taken
  uint flushes;
};

/// A cluster of one instance that touches pages to draw.
struct PageCluster {
  uint cluster;
  uint instance;
  uint face;
  uint levels;          // bit l: may touch pages of level l
  uint first_triangle;  // where its triangles' corners stand in this round
};

/// What is drawn as one: a page, or a whole block of pages that are neighbours in the pool too: its first place,
/// and this.
const uint unit_block = 0x10000u;

/// draw=superpages: what is drawn by one pass over the casters, and copied to the pool.
struct SuperpagePlace {
  uint face;
  uint level;
  uvec2 first_page;  // at its corner
};

/// World bounds in which casters have changed.
struct ChangedBox {
  vec3 low, high;
};

struct BinConstants {
  uint cluster_count;
  uint cluster_capacity;
  uint first_pair[pair_kinds + 1];  // room for each kind
  uint triangle_capacity;
  uint round;
  uint kinds;   // render::InstanceFilter
  float reach;  // texels: how far a triangle may lie from a texel's centre and be drawn there, along each axis
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
