// precomputed: visibility from the voxel DAG (CPVS 2014, section 6.2); the layout is told in voxel/dag.h.
//
// A receiver's voxel picks a cell of the grid, then a child at every level, down to leaves of 8 x 8 voxels of one depth.
// A filter of up to 17 x 17 voxels touches up to 2 x 2 parents of 16 x 16 voxels and in each up to 2 x 2 leaves. Their paths
// part at one height in x and at one in y: the walk keeps the node at the higher of the two and the node at the lower, and
// turns back to no other (figure 7, without a stack). Whole nodes inside the filter are counted without going on.
//
// PRECOMPUTED_REAL: double or float, see ReceiverRows. PRECOMPUTED_ACCESS: how words are read.
#ifndef SHADEWRIGHT_PRECOMPUTED_GLSL
#define SHADEWRIGHT_PRECOMPUTED_GLSL

#ifdef PRECOMPUTED_DOUBLE
#define real double
#define real4 dvec4
#else
#define real float
#define real4 vec4
#endif
#include "shadow/precomputed/shared.h"

#ifndef SHADEWRIGHT_LOOKUP_SET
#define SHADEWRIGHT_LOOKUP_SET 1
#endif

// What a pipeline is specialized for; see `Variant` in precomputed.cpp.
layout(constant_id = 0) const uint variant = 1u;
const uint taps = variant & 0xffu;
const bool far_mraa = (variant & 0x100u) != 0u, far_voaa = (variant & 0x200u) != 0u;
const bool fixed_order = (variant & 0x400u) != 0u, one_window = (variant & 0x800u) != 0u;
const bool leaf_by_leaf = (variant & 0x2000u) != 0u;

#ifdef SHADEWRIGHT_LOADS_FIRST  // see loads_first.glsl
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 0, scalar) uniform Precomputed {
  LookupData lookup_uniform;
  PrecomputedData precomputed;
};
LookupData lookup;
void load_lookup() { lookup = lookup_uniform; }
#else
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 0, scalar) uniform Precomputed {
  LookupData lookup;
  PrecomputedData precomputed;
};
#endif
uint light_kind() { return lookup.light_kind; }
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 1, scalar) uniform Rows { ReceiverRows rows; };

#if defined(PRECOMPUTED_IMAGE)
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2) uniform usampler2D dag_image;
uint dag_word(uint at) { return texelFetch(dag_image, ivec2(at & 16383u, at >> 14), 0).r; }
#elif defined(PRECOMPUTED_ADDRESS)
layout(buffer_reference, scalar) readonly buffer DagWords { uint words[]; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2, scalar) uniform DagAddress { DagWords dag_address; };
uint dag_word(uint at) { return dag_address.words[at]; }
#else
// 2^25 words are 128 MB, what every device binds at once.
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2, scalar) readonly buffer Window0 { uint window0[]; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 3, scalar) readonly buffer Window1 { uint window1[]; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 4, scalar) readonly buffer Window2 { uint window2[]; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 5, scalar) readonly buffer Window3 { uint window3[]; };
uint dag_word(uint at) {
  if (one_window) return window0[at];
  uint within = at & 0x1ffffffu;
  switch (at >> 25) {
    case 0: return window0[within];
    case 1: return window1[within];
    case 2: return window2[within];
    default: return window3[within];
  }
}
#endif

// A node on the way down, at a word offset in its DAG's nodes; 0 and 1 stand for volumes that are shadowed or visible as a
// whole. Heights above the grid's have no node: the walk has not begun.
struct DagNode {
  uint at;
  uint height;
};
const DagNode dag_start = DagNode(2u, 32u);

const uint dag_slab_height = 3u, dag_parent_height = 4u;

uint dag_code(uint header, uint child) { return (header >> (2u * child)) & 3u; }

// Follows the pointer of an intersected child.
uint dag_pointer(DagPlace dag, uint at, uint header, uint owner) {
  uint own = header & 0xaaaau & ~(header << 1);
  return dag_word(dag.nodes + at + uint(bitCount(own & ((4u << (2u * owner)) - 1u))));
}

// Walks towards `voxel` until `height` (at least 3) or the end.
DagNode dag_descend(DagPlace dag, DagNode node, uvec3 voxel, uint height) {
  uint top = dag.log2_size - dag.log2_grid;
  if (node.height > top) {
    if (height > top) return node;
    uvec3 cell = voxel >> top;
    node = DagNode(dag_word(dag.grid + cell.x + (cell.y << dag.log2_grid) + (cell.z << (2u * dag.log2_grid))), top);
  }
  while (node.height > height && node.at > 1u) {
    uint bit = --node.height;
    uint child = (voxel.x >> bit & 1u) | (voxel.y >> bit & 1u) << 1 | (voxel.z >> bit & 1u) << 2;
    uint header = dag_word(dag.nodes + node.at), code = dag_code(header, child);
    // Code 3: as the child with z = 0.
    node.at = code < 2u ? code : dag_pointer(dag, node.at, header, code == 3u ? child & 3u : child);
  }
  return node;
}

// The 8 x 8 voxels of depth z in a node of height 3, row by row.
uvec2 dag_leaf(DagPlace dag, uint at, uint z) {
  if (at <= 1u) return uvec2(0u - at);
  uint slab = z & 7u, header = dag_word(dag.nodes + at), code = dag_code(header, slab);
  if (code < 2u) return uvec2(0u - code);
  // Code 3: as the last slab before it with a pointer of its own, which is where counting up to it ends.
  uint leaf = dag.leaves + 2u * dag_pointer(dag, at, header, slab);
  return uvec2(dag_word(leaf), dag_word(leaf + 1u));
}

// Rows 0..count-1 of four rows of eight bits; a shift by 32 is not defined.
uint dag_rows_below(int count) { return count > 3 ? ~0u : (1u << (8 * count)) - 1u; }

// The bits of the leaf at `corner` that lie in [low, high] (figure 6).
uvec2 dag_filter_mask(ivec2 corner, ivec2 low, ivec2 high) {
  ivec2 first = max(low - corner, 0), last = min(high - corner, 7);
  uint columns = (0xffu >> (7 - last.x)) & (0xffu << first.x);
  ivec2 from = clamp(first.y - ivec2(0, 4), 0, 4), end = clamp(last.y + 1 - ivec2(0, 4), 0, 4);
  uvec2 rows = uvec2(dag_rows_below(end.x), dag_rows_below(end.y)) & ~uvec2(dag_rows_below(from.x), dag_rows_below(from.y));
  return columns * 0x01010101u & rows;
}

// Visible voxels of [low, high] inside one parent of 16 x 16.
uint dag_count_parent(DagPlace dag, DagNode parent, ivec2 low, ivec2 high, uint z) {
  ivec2 size = high - low + 1;
  if (parent.at <= 1u) return parent.at * uint(size.x * size.y);
  uint lit = 0u;
  for (int y = low.y >> 3; y <= high.y >> 3; ++y)
    for (int x = low.x >> 3; x <= high.x >> 3; ++x) {
      ivec2 corner = ivec2(x, y) * 8;
      DagNode node = dag_descend(dag, parent, uvec3(corner, z), dag_slab_height);
      uvec2 inside = dag_leaf(dag, node.at, z) & dag_filter_mask(corner, low, high);
      lit += uint(bitCount(inside.x) + bitCount(inside.y));
    }
  return lit;
}

// Visible voxels of [low, high], each leaf from the node where the first and the last part. More steps than in the best order,
// but one loop: lanes of a wide processor wait less for each other.
uint dag_count_leaves(DagPlace dag, ivec2 low, ivec2 high, uint z) {
  uint apart = uint(findMSB((low.x ^ high.x) | (low.y ^ high.y)) + 1);
  DagNode all = dag_descend(dag, dag_start, uvec3(low, z), max(apart, dag_slab_height));
  ivec2 size = high - low + 1;
  if (all.at <= 1u) return all.at * uint(size.x * size.y);
  uint lit = 0u;
  ivec2 first = low >> 3, last = high >> 3, at = first;
  while (at.y <= last.y) {
    ivec2 corner = at * 8;
    uvec2 inside = dag_leaf(dag, dag_descend(dag, all, uvec3(corner, z), dag_slab_height).at, z);
    inside &= dag_filter_mask(corner, low, high);
    lit += uint(bitCount(inside.x) + bitCount(inside.y));
    bool row_ends = at.x == last.x;
    at = row_ends ? ivec2(first.x, at.y + 1) : ivec2(at.x + 1, at.y);
  }
  return lit;
}

ivec2 dag_ordered(ivec2 v, bool x_first) { return x_first ? v : v.yx; }

// Mean of the filter around `voxel` (z at least 0). Outside in x and y is visible.
float dag_filtered(DagPlace dag, ivec3 voxel, uint z) {
  int last = int(1u << dag.log2_size) - 1, reach = int(taps / 2u);
  ivec2 low = max(voxel.xy - reach, 0), high = min(voxel.xy + reach, last);
  if (any(greaterThan(low, high))) return 1.0;
  if (taps == 1u) {
    DagNode node = dag_descend(dag, dag_start, uvec3(low, z), dag_slab_height);
    uint bit = uint(low.y & 7) * 8u + uint(low.x & 7);
    uvec2 leaf = dag_leaf(dag, node.at, z);
    return float((bit < 32u ? leaf.x >> bit : leaf.y >> (bit - 32u)) & 1u);
  }

  ivec2 filter_size = high - low + 1;
  uint outside = taps * taps - uint(filter_size.x * filter_size.y);
  if (leaf_by_leaf) return float(dag_count_leaves(dag, low, high, z) + outside) / float(taps * taps);

  // The height of the smallest node that holds both ends, per axis; what lies in one parent does not part.
  uvec2 apart = max(uvec2(findMSB(low ^ high) + 1), dag_parent_height);
  bool x_first = fixed_order || apart.x > apart.y;
  // (outer axis, inner axis); which of the two is x follows from x_first.
  ivec2 first = dag_ordered(low, x_first), last_one = dag_ordered(high, x_first);
  uint inner_height = x_first ? apart.y : apart.x;
  DagNode all = dag_descend(dag, dag_start, uvec3(low, z), max(apart.x, apart.y));
  uint lit = 0u;
  for (int outer = first.x; outer <= last_one.x; outer = (outer | 15) + 1) {
    ivec2 from = dag_ordered(ivec2(outer, first.y), x_first);
    DagNode half_way = dag_descend(dag, all, uvec3(from, z), inner_height);
    for (int inner = first.y; inner <= last_one.y; inner = (inner | 15) + 1) {
      ivec2 corner = dag_ordered(ivec2(outer, inner), x_first), end = min(high, corner | 15);
      lit += dag_count_parent(dag, dag_descend(dag, half_way, uvec3(corner, z), dag_parent_height), corner, end, z);
    }
  }
  return float(lit + outside) / float(taps * taps);
}

// The share of visible voxels in the node of side 2^height (3 to the grid's) around a voxel inside the volume.
float dag_node_visibility(DagPlace dag, uvec3 voxel, uint height) {
  DagNode node = dag_descend(dag, dag_start, voxel, height);
  return node.at <= 1u ? float(node.at) : 1.0 - float(dag_word(dag.nodes + node.at) >> 16) / 65535.0;
}

// What a receiver's offset makes room for beyond the half of what is looked up: 1/32 voxel, see LightGrid::receiver_offset.
const real receiver_slack = real(1.0) / real(32.0);
// The cosine below which a distant receiver's offset towards the light grows no more.
const float grazing = 0.1;

// The voxel, in the finest DAG, of a point relative to `rows.origin`, and the place in it. False before the volume and far beside it,
// where all is visible.
bool voxel_at(real px, real py, real pz, out ivec3 voxel, out vec3 within) {
  real4 vx = rows.voxel[0], vy = rows.voxel[1], vz = rows.voxel[2], vw = rows.voxel[3];
  precise real qx = (vx.x * px + vx.y * py) + (vx.z * pz + vx.w);
  precise real qy = (vy.x * px + vy.y * py) + (vy.z * pz + vy.w);
  precise real qz = (vz.x * px + vz.y * py) + (vz.z * pz + vz.w);
  if (light_kind() == light_spot) {
    precise real w = (vw.x * px + vw.y * py) + (vw.z * pz + vw.w);
    if (!(w > real(0.0))) return false;
    qx = qx / w;
    qy = qy / w;
    qz = qz / w;
  }
  const real far_out = real(4e6);
  if (!(abs(qx) < far_out) || !(abs(qy) < far_out) || !(qz > -far_out)) return false;
  qz = min(qz, real(3e6));
  voxel = rows.base + ivec3(int(floor(qx)), int(floor(qy)), int(floor(qz)));
  within = vec3(float(qx - floor(qx)), float(qy - floor(qy)), float(qz - floor(qz)));
  return voxel.z >= 0;
}

bool voxel_at(real px, real py, real pz, out ivec3 voxel) {
  vec3 within;
  return voxel_at(px, py, pz, voxel, within);
}

// The distance along a spot's axis of a point relative to `rows.origin`; 1 for directional lights.
real spot_distance(real px, real py, real pz) {
  real4 vw = rows.voxel[3];
  precise real w = (vw.x * px + vw.y * py) + (vw.z * pz + vw.w);
  return light_kind() == light_spot ? w : real(1.0);
}

// The voxel of a receiver moved along its normal, so that no tap of its filter reaches below its own plane.
bool receiver_voxel(vec3 world, vec3 normal, out ivec3 voxel) {
  precise real px = world.x - rows.origin.x, py = world.y - rows.origin.y, pz = world.z - rows.origin.z;
  precise real nx = normal.x, ny = normal.y, nz = normal.z;
  real4 lx = rows.light[0], ly = rows.light[1], lz = rows.light[2];
  precise real ax = abs((lx.x * nx + lx.y * ny) + (lx.z * nz + lx.w));
  precise real ay = abs((ly.x * nx + ly.y * ny) + (ly.z * nz + ly.w));
  precise real az = abs((lz.x * nx + lz.y * ny) + (lz.z * nz + lz.w));
  precise real half_width = real(0.5) * real(taps) + receiver_slack;
  precise real w = spot_distance(px, py, pz);
  precise real across = ((half_width * rows.reach_x) * ax + (half_width * rows.reach_y) * ay) * w;
  precise real along = (((real(0.5) + receiver_slack) * rows.reach_z) * az) * (w * w);
  precise real offset = across + along;
  return voxel_at(px + nx * offset, py + ny * offset, pz + nz * offset, voxel);
}

vec3 towards_light(vec3 world) {
  return light_kind() == light_spot ? normalize(lookup.light_position - world) : -lookup.light_direction;
}

// The cosine between a distant receiver's normal and the light, but for grazing ones.
float facing_light(vec3 world, vec3 normal) { return max(abs(dot(normal, towards_light(world))), grazing); }

// The voxel of a receiver whose pixel covers many texels, for a look-up that reaches `half_width` voxels along x and y and
// `half_depth` along z. It moves towards the light, out of the filter's reach of its own plane: along the normal, as near
// receivers do, so wide an offset would move the shadow's edge by half a pixel.
bool distant_voxel(vec3 world, vec3 normal, real half_width, real half_depth, out ivec3 voxel) {
  real px = world.x - rows.origin.x, py = world.y - rows.origin.y, pz = world.z - rows.origin.z;
  vec3 to_light = towards_light(world);
  real4 lx = rows.light[0], ly = rows.light[1];
  real w = spot_distance(px, py, pz);
  real across = abs(lx.x * normal.x + lx.y * normal.y + lx.z * normal.z) * rows.reach_x +
                abs(ly.x * normal.x + ly.y * normal.y + ly.z * normal.z) * rows.reach_y;
  real offset = half_width * across * w / real(facing_light(world, normal)) + half_depth * rows.reach_z * w * w;
  return voxel_at(px + to_light.x * offset, py + to_light.y * offset, pz + to_light.z * offset, voxel);
}

// The square root of a pixel's area in the light's texels, from the receiver's plane.
float receiver_footprint(vec3 world, vec3 normal) {
  vec3 from_eye = world - lookup.eye;
  float view_depth = dot(from_eye, precomputed.view_axis);
  vec3 ray = normalize(from_eye);
  vec2 texel = precomputed.texel_size;
  vec3 light = lookup.light_direction;
  if (light_kind() == light_spot) {
    vec3 from_light = world - lookup.light_position;
    texel *= dot(from_light, light);
    light = normalize(from_light);
  }
  // Seen from the eye, the surface's patch has the pixel's solid angle; seen from the light, its own.
  float patch_area = precomputed.pixel_area * view_depth * view_depth * dot(ray, precomputed.view_axis) /
                     max(abs(dot(ray, normal)), 1e-6);
  return sqrt(patch_area * abs(dot(light, normal)) / (texel.x * texel.y));
}

// How deep the receiver's plane falls from column to column: voxels of depth a voxel along x and y.
vec2 plane_slope(vec3 world, vec3 normal) {
  real px = world.x - rows.origin.x, py = world.y - rows.origin.y, pz = world.z - rows.origin.z;
  real4 lx = rows.light[0], ly = rows.light[1];
  vec2 n = vec2(lx.x * normal.x + lx.y * normal.y + lx.z * normal.z, ly.x * normal.x + ly.y * normal.y + ly.z * normal.z);
  return n * vec2(rows.reach_x, rows.reach_y) / (facing_light(world, normal) * float(rows.reach_z * spot_distance(px, py, pz)));
}

// The occupancy of the last node of side 2^height in the receiver's column that ends before the receiver's plane: LightGrid::clear_node.
float clear_node_visibility(DagPlace dag, ivec3 voxel, vec3 within, vec2 slope, uint height) {
  float side = exp2(float(height));
  vec2 low = -(vec2(voxel.xy & ((1 << height) - 1)) + within.xy);
  vec2 rise = min(slope * low, slope * (low + side));
  int nearest = voxel.z + int(floor(within.z + rise.x + rise.y - (0.5 + float(receiver_slack)))), node = (nearest >> height) - 1;
  if (node < 0) return 1.0;
  return dag_node_visibility(dag, uvec3(voxel.xy, min(uint(node) << height, precomputed.depth - 1u)), height);
}

float occupancy_visible(vec3 world, vec3 normal, float side) {
  DagPlace dag = precomputed.dags[0];
  float height = clamp(log2(side), float(dag_slab_height), float(dag.log2_size - dag.log2_grid));
  precise real px = world.x - rows.origin.x, py = world.y - rows.origin.y, pz = world.z - rows.origin.z;
  ivec3 voxel;
  vec3 within;
  if (!voxel_at(px, py, pz, voxel, within)) return 1.0;
  if (any(lessThan(voxel.xy, ivec2(0))) || any(greaterThanEqual(voxel.xy, ivec2(1 << dag.log2_size)))) return 1.0;
  vec2 slope = plane_slope(world, normal);
  float fine = clear_node_visibility(dag, voxel, within, slope, uint(height)), between = fract(height);
  return between == 0.0 ? fine : mix(fine, clear_node_visibility(dag, voxel, within, slope, uint(height) + 1u), between);
}

float filter_visible(vec3 world, vec4 plane) {
  vec3 normal = plane.xyz;
  uint level = 0u;
  if (far_mraa || far_voaa) {
    float side = receiver_footprint(world, normal);
    // Nodes stand on a grid, not around the receiver: half as wide as the pixel, they reach about as far.
    if (far_voaa && side > float(taps)) return occupancy_visible(world, normal, 0.5 * side);
    if (far_mraa && side > float(taps))
      level = uint(min(log2(side / float(taps)), float(precomputed.dag_count - 1u)));
  }
  ivec3 voxel;
  real size = real(1 << level);
  bool inside = level == 0u ? receiver_voxel(world, normal, voxel)
                            : distant_voxel(world, normal, (real(0.5) * real(taps) + receiver_slack) * size,
                                            (real(0.5) + receiver_slack) * size, voxel);
  if (!inside) return 1.0;
  // A coarser DAG's voxels hold whole ones of the finest; shifts of negative numbers round down.
  voxel >>= int(level);
  return dag_filtered(precomputed.dags[level], voxel, min(uint(voxel.z), (precomputed.depth >> level) - 1u));
}

#endif
