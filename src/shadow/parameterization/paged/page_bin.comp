// Cuts the scene into (triangle, page) pairs: for each triangle of a touched cluster, every page to draw in which it may cover a
// texel's centre gets the triangle's corners, in the page's place in the pool. A cluster whose pairs do not fit waits for the
// next round; what it has drawn already is then drawn twice, which changes nothing.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Draw { uint draw[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Touched { PageCluster touched[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Late { PageCluster late[]; };
layout(set = 0, binding = 7, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 8, scalar) writeonly buffer Vertices { PageVertex vertices[]; };
layout(push_constant, scalar) uniform Push { BinConstants constants; };

shared uint overflow;

// How far a corner may be off, in texels of a level of this size: the rasterizer snaps to 1/256, and float has its error.
float slack_of(float size) { return 1.0 / 64.0 + size * 3e-7; }

void emit(vec3 corners[3], float size, uvec2 page, uint slot) {
  uint first = atomicAdd(state.wanted_vertices, 3);
  if (first + 3 > constants.vertex_capacity) {
    overflow = 1;
    return;
  }
  vec2 place = vec2(slot % paged.pool_width, slot / paged.pool_width) - vec2(page);
  float pool = 2.0 / float(paged.pool_width * page_texels);
  for (int k = 0; k < 3; ++k) {
    vec2 texel = corners[k].xy * size + place * float(page_texels);
    vertices[first + k] = PageVertex(vec3(texel * pool - 1.0, corners[k].z), slot);
  }
}

// Whether a triangle may cover the centre of a texel of a page. `first` and `last` are the texels whose centres its bounds hold.
bool covers(vec3 corners[3], float size, uvec2 page, vec2 first, vec2 last) {
  vec2 center = (vec2(page) + 0.5) * float(page_texels);
  vec2 a = max(first, vec2(page * page_texels)), b = min(last, vec2(page * page_texels + page_texels - 1u));
  float slack = slack_of(size);
  vec2 from[3];
  for (int k = 0; k < 3; ++k) from[k] = corners[k].xy * size - center;
  float turn = determinant(mat2(from[1] - from[0], from[2] - from[0])) < 0.0 ? -1.0 : 1.0;
  vec3 edges[3];  // signed distances times length, inside positive
  vec2 middle = 0.5 * (a + b) + 0.5 - center, reach = 0.5 * (b - a);
  for (int k = 0; k < 3; ++k) {
    vec2 along = (from[(k + 1) % 3] - from[k]) * turn;
    vec2 normal = vec2(-along.y, along.x);
    edges[k] = vec3(normal, -dot(normal, from[k]) + slack * (abs(normal.x) + abs(normal.y)));
    if (dot(normal, middle) + edges[k].z + dot(abs(normal), reach) < 0.0) return false;
  }
  // A few texels are looked at one by one: most triangles of a fine mesh lie between the centres of a coarse level.
  uvec2 extent = uvec2(b - a) + 1u;
  if (extent.x * extent.y > 16u) return true;
  for (uint i = 0; i < extent.x * extent.y; ++i) {
    vec2 p = a + vec2(i % extent.x, i / extent.x) + 0.5 - center;
    if (all(greaterThanEqual(vec3(dot(edges[0].xy, p) + edges[0].z, dot(edges[1].xy, p) + edges[1].z,
                                  dot(edges[2].xy, p) + edges[2].z), vec3(0.0))))
      return true;
  }
  return false;
}

void bin_level(vec3 corners[3], vec2 low, vec2 high, uint face, uint level) {
  float size = level_size(level), slack = slack_of(size);
  vec2 first = clamp(ceil(low * size - 0.5 - slack), vec2(0.0), vec2(size)),
       last = clamp(floor(high * size - 0.5 + slack), vec2(-1.0), vec2(size - 1.0));
  if (any(greaterThan(first, last))) return;
  uvec2 a = uvec2(first) / page_texels, b = uvec2(last) / page_texels;
  // Blocks of 8 x 4 pages are the words of the mask; small levels have less than a block.
  uvec2 block_a = a / uvec2(8, 4), block_b = b / uvec2(8, 4);
  for (uint by = block_a.y; by <= block_b.y; ++by)
    for (uint bx = block_a.x; bx <= block_b.x; ++bx) {
      uint word = page_index(face, level, uvec2(bx * 8, by * 4)) >> 5;
      for (uint bits = draw[word]; bits != 0; bits &= bits - 1) {
        uint bit = uint(findLSB(bits));
        uvec2 page = uvec2(bx * 8, by * 4) + z_curve_place(bit);
        if (any(lessThan(page, a)) || any(greaterThan(page, b))) continue;
        if (covers(corners, size, page, first, last)) emit(corners, size, page, entry_slot(page_table[word * 32u + bit]));
      }
    }
}

void bin(vec3 corners[3], uint face, uint levels) {
  vec2 low = min(min(corners[0].xy, corners[1].xy), corners[2].xy);
  vec2 high = max(max(corners[0].xy, corners[1].xy), corners[2].xy);
  for (; levels != 0; levels &= levels - 1) bin_level(corners, low, high, face, uint(findLSB(levels)));
}

vec3 divided(vec4 q) { return q.xyz / q.w; }

void main() {
  if (gl_LocalInvocationIndex == 0) overflow = 0;
  barrier();
  uint place = gl_WorkGroupID.y * 32768u + gl_WorkGroupID.x;
  bool works = place < min(state.visible_clusters, constants.cluster_capacity);
  PageCluster part;
  if (works) {
    part = touched[place];
    ClusterData cluster = clusters[part.cluster];
    mat4 map_from_world = map_views[part.face].map_from_world;
    mat4x3 world_from_mesh = instances[part.instance].world_from_mesh;
    float near = paged.near[part.face];
    for (uint t = gl_LocalInvocationIndex; t < cluster.index_count / 3; t += 64) {
      vec4 q[3];
      int behind = 0;
      for (int k = 0; k < 3; ++k) {
        vec3 world = world_from_mesh * vec4(positions[indices[cluster.first_index + 3 * t + k]], 1.0);
        q[k] = map_from_world * vec4(world, 1.0);
        behind += q[k].w < near ? 1 : 0;
      }
      if (behind == 3) continue;
      if (behind == 0) {
        bin(vec3[3](divided(q[0]), divided(q[1]), divided(q[2])), part.face, part.levels);
        continue;
      }
      // A perspective light's triangle that reaches behind the light: what is left before it has three or four corners.
      vec3 cut[4];
      int count = 0;
      for (int k = 0; k < 3; ++k) {
        vec4 from = q[k], to = q[(k + 1) % 3];
        if (from.w >= near) cut[count++] = divided(from);
        if ((from.w >= near) != (to.w >= near)) cut[count++] = divided(mix(from, to, (near - from.w) / (to.w - from.w)));
      }
      bin(vec3[3](cut[0], cut[1], cut[2]), part.face, part.levels);
      if (count == 4) bin(vec3[3](cut[0], cut[2], cut[3]), part.face, part.levels);
    }
  }
  barrier();
  if (works && gl_LocalInvocationIndex == 0 && overflow != 0) late[atomicAdd(state.late_clusters, 1)] = part;
}
