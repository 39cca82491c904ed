// paged: a quadtree of pages over a virtual map; a pixel asks the level whose texels are of its own size (RMSM, section 3.3).
// The parameterization module of a look-up (architecture, section 1). MapPoint::layer holds the page that answers: its place in
// the pool, its level and its face.
#include "shadow/map_point.glsl"
#include "shadow/parameterization/cube_face.glsl"
#include "shadow/parameterization/paged/shared.h"

#define MAP_LEVELS 1  // map_level and map_point_at exist
#define MAP_PAIRS 1   // casters are drawn as (triangle, unit) pairs

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 1, scalar) SHADEWRIGHT_UNIFORM(PagedConstants, paged, load_map)
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2, scalar) readonly buffer State { PageState page_state; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 3, scalar) readonly buffer Table { uint page_table[]; };

#include "shadow/parameterization/paged/pages.glsl"

bool is_current(uint entry) { return is_of(entry, page_state.epoch); }

const uint no_page = ~0u;

float level_size(uint level) { return float((page_texels << paged.top) >> level); }

// The entry of the finest page at `level` or above that holds a place of a face; no_page if none does. That it is not the first
// one read is the exception: pixels asked for what they read.
uint find_page(uint face, uint level, vec2 uv) {
  uvec2 page = uvec2(clamp(uv * level_size(level), vec2(0.0), vec2(level_size(level) - 1.0))) / page_texels;
  for (; level <= paged.top; ++level) {
    uint entry = page_table[page_index(face, level, page)];
    if (is_current(entry)) return entry;
    page >>= 1;
  }
  return no_page;
}

uint point_place(MapPoint p) { return entry_place(p.layer); }
uint point_level(MapPoint p) { return entry_level(p.layer); }
uint point_face(MapPoint p) { return p.layer >> (place_bits + entry_level_bits); }

uint paged_face(vec3 world) { return six_faces() ? cube_face(world - lookup.light_position) : 0; }

vec2 paged_uv(vec3 world, uint face) {
  vec4 q = map_view(face).map_from_world * vec4(world, 1.0);
  return q.xy / q.w;
}

// Equation 1: l = log2 sqrt |dX x dY|, where dX, dY are the steps of one pixel in the map, in texels of level 0. From the
// receiver's plane, not from neighbouring pixels, which belong to other surfaces at edges.
float map_level(vec3 world, vec4 plane) {
  uint face = paged_face(world);
  vec3 ray = world - lookup.eye;
  float depth = dot(paged.view_axis, ray), facing = dot(plane.xyz, ray);
  facing = abs(facing) < 1e-20 ? 1e-20 : facing;
  vec3 world_x = depth * (paged.pixel_x - ray * (dot(plane.xyz, paged.pixel_x) / facing));
  vec3 world_y = depth * (paged.pixel_y - ray * (dot(plane.xyz, paged.pixel_y) / facing));
  mat4 m = map_view(face).map_from_world;
  vec4 q = m * vec4(world, 1.0);
  vec3 x = vec3(m[0].xy, m[0].w) * world_x.x + vec3(m[1].xy, m[1].w) * world_x.y + vec3(m[2].xy, m[2].w) * world_x.z;
  vec3 y = vec3(m[0].xy, m[0].w) * world_y.x + vec3(m[1].xy, m[1].w) * world_y.y + vec3(m[2].xy, m[2].w) * world_y.z;
  float scale = level_size(0) / q.w;
  vec2 dx = (x.xy - q.xy / q.w * x.z) * scale, dy = (y.xy - q.xy / q.w * y.z) * scale;
  float area = abs(dx.x * dy.y - dx.y * dy.x);
  float texels = sqrt(area);
  if (paged.lod == lod_box) texels = max(length(dx), length(dy));
  if (paged.lod == lod_axis || paged.lod == lod_bounded) {
    // The smaller singular value of (dX dY): s1 s2 = area, s1^2 + s2^2 = |dX|^2 + |dY|^2.
    float sum = dot(dx, dx) + dot(dy, dy);
    float axis = sqrt(max(0.0, 0.5 * (sum - sqrt(max(0.0, sum * sum - 4.0 * area * area)))));
    texels = paged.lod == lod_axis ? axis : min(texels, 2.0 * axis);
  }
  float level = texels > 0.0 ? log2(texels) : 0.0;
  float finest = float(max(paged.finest, page_state.finest));
  return clamp(level, finest, max(finest, float(paged.coarsest)));
}

// The finest page at `level` or above answers for `world`, through a face that holds it.
MapPoint map_point_at(vec3 world, vec4 plane, uint level) {
  uint face = paged_face(world);
  uint entry = find_page(face, level, paged_uv(world, face));
  uint found = entry == no_page ? level : entry_level(entry);
  MapPoint p = map_project(map_view(face), 0, world, plane, vec2(1.0 / level_size(found)));
  p.layer = entry_place(entry) | found << place_bits | face << (place_bits + entry_level_bits);
  p.valid = p.valid && entry != no_page;
  return p;
}

MapPoint map_point(vec3 world, vec4 plane) { return map_point_at(world, plane, uint(map_level(world, plane))); }

vec3 map_unproject(MapPoint p, vec2 uv, float depth) {
  return map_unproject_view(map_view(point_face(p)), uv, depth);
}

// The place `uv` of p's face on the receiver's plane, which is near p: answered by the page that holds it.
MapPoint map_tap(MapPoint p, vec2 uv) {
  float depth = p.depth + dot(uv - p.uv, p.gradient);
  uint level = point_level(p);
  vec2 inner = uv / p.texel, own = p.uv / p.texel;
  if (all(equal(floor(inner / float(page_texels)), floor(own / float(page_texels))))) {
    p.uv = uv;
    p.depth = depth;
    return p;
  }
  uint face = point_face(p), entry = find_page(face, level, uv);
  p.uv = uv;
  p.depth = depth;
  p.valid = entry != no_page && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
  if (!p.valid) return p;
  p.texel = vec2(1.0 / level_size(entry_level(entry)));
  p.layer = entry_place(entry) | entry_level(entry) << place_bits | face << (place_bits + entry_level_bits);
  return p;
}

// The texel of its level that p lies in.
ivec2 map_texel(MapPoint p) { return ivec2(floor(p.uv * level_size(point_level(p)))); }

// Map depth that a texel's width along the light makes: a view tells that of a map of the pool's size.
float level_slope_unit(uint face, uint level) { return map_view(face).slope_unit * lookup.map_size.x / level_size(level); }
float map_slope_unit(MapPoint p) { return level_slope_unit(point_face(p), point_level(p)); }

// The texel at p's own plus `offset`, on whichever page it is; false where no page of p's level has it.
bool map_fetch(MapPoint p, ivec2 offset, out ivec3 address) {
  uint level = point_level(p), place = point_place(p);
  ivec2 own = map_texel(p), texel = own + offset;
  if (any(greaterThanEqual(texel ^ own, ivec2(page_texels))) || any(lessThan(texel, ivec2(0)))) {
    uvec2 page = uvec2(texel) / page_texels;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(page, uvec2(1u << (paged.top - level))))) return false;
    uint entry = page_table[page_index(point_face(p), level, page)];
    if (!is_current(entry) || entry_level(entry) != level) return false;
    place = entry_place(entry);
  }
  address = ivec3(ivec2(place_page(place) * page_texels) + (texel & int(page_texels - 1u)), 0);
  return true;
}

// Where the pool holds the corner between the texels `first` and `first` + 1 of p's level, and which of the four lie on p's page.
bvec4 map_quad(MapPoint p, vec2 first, out vec3 at) {
  vec2 page = floor(p.uv / p.texel / float(page_texels)) * float(page_texels);
  vec2 within = first - page;
  at = vec3((place_texel(point_place(p)) + within + 1.0) / float(paged.pool_width * page_texels), 0.0);
  bvec2 low = greaterThanEqual(within, vec2(0.0)), high = lessThan(within, vec2(page_texels - 1u));
  return bvec4(low.x && high.y, high.x && high.y, high.x && low.y, low.x && low.y);  // textureGather's order
}

#include "shadow/parameterization/ray.glsl"
