// The light's ray through a place of the map. Needs the parameterization's map_unproject before it.
Ray map_ray(MapPoint p, vec2 uv) {
  vec3 near = map_unproject(p, uv, 0.0);
  return Ray(near, normalize(map_unproject(p, uv, 1.0) - near));
}
