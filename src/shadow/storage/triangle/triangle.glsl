// triangle: a texel keeps the closest triangle at its centre; the receiver's ray to the light is tested against those of the texels
// around it (RGSM 2008). The storage module of a look-up; needs a parameterization before it.

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 8) uniform sampler2DArray triangle_depth;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 9) uniform sampler2DArray triangle_first;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 10) uniform sampler2DArray triangle_second;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 11) uniform sampler2DArray triangle_third;

// Where along the ray the triangle lies; infinity where it does not meet (Möller and Trumbore 1997).
float triangle_hit(Ray ray, vec3 a, vec3 b, vec3 c) {
  vec3 u = b - a, v = c - a, across = cross(ray.direction, v), from = ray.origin - a, turned = cross(from, u);
  float determinant = dot(u, across);
  vec2 at = vec2(dot(from, across), dot(ray.direction, turned)) / determinant;
  bool inside = determinant != 0.0 && at.x >= 0.0 && at.y >= 0.0 && at.x + at.y <= 1.0;
  return inside ? dot(v, turned) / determinant : 1.0 / 0.0;
}

float storage_visible(MapPoint p) {
  if (!p.valid) return 1.0;
  // From just before the receiver towards the light.
  vec3 receiver = map_unproject(p, p.uv, p.depth - lookup.bias_scale * p.tolerance);
  Ray ray = Ray(receiver, -map_ray(p, p.uv).direction);
  float farthest = light_kind() == light_directional ? 1.0 / 0.0 : distance(receiver, lookup.light_position);
  int reach = lookup.triangle_reach;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec3 at;
      if (!map_fetch(p, ivec2(x, y), at) || texelFetch(triangle_depth, at, 0).r == 1.0) continue;
      vec4 first = texelFetch(triangle_first, at, 0), second = texelFetch(triangle_second, at, 0);
      float third = texelFetch(triangle_third, at, 0).r;
      float hit = triangle_hit(ray, first.xyz, vec3(first.w, second.xy), vec3(second.zw, third));
      if (hit > 0.0 && hit < farthest) return 0.0;
    }
  return 1.0;
}
