// Importance functions (the paper's section 5), each in [0, inf): how many texels along u and along v a receiver deserves, relative
// to others. Their product counts. Adding one is adding a bit to shared.h and a line to `importance`.
// Needs receivers.glsl and map_views before it.

// DE: a surface shrinks in the picture with its view depth. Relative to the near plane, so at most 1.
float distance_to_eye(CameraData camera, float view_depth) {
  return camera_view_depth(camera, 1.0 - camera.background_depth) / view_depth;
}

// SN: surfaces that face the eye, up to 1.
float surface_normal(vec3 normal, vec3 to_eye, float weight) {
  return (1.0 + weight * clamp(dot(normal, normalize(to_eye)), 0.0, 1.0)) / (1.0 + weight);
}

// Pixels that a step across the map moves the light's ray on the receiver's plane: what DE and SN stand for, exactly.
vec2 pixels_a_step(CameraData camera, vec3 world, vec3 normal, vec3 ray, vec3 map, Orientation o) {
  mat4 world_from_map = map_first_view.world_from_map;
  vec4 q = world_from_map * vec4(map, 1.0);
  vec3 along_u = (world_from_map[0].xyz - world * world_from_map[0].w) / q.w, along_v = (world_from_map[1].xyz - world * world_from_map[1].w) / q.w;
  mat2 map_from_whole = inverse(transpose(mat2(o.u.xy, o.v.xy)));
  vec4 clip = camera.clip_from_relative * vec4(world - camera.eye, 1.0);
  vec2 pixels;
  for (int axis = 0; axis < 2; ++axis) {
    vec3 across = along_u * map_from_whole[axis].x + along_v * map_from_whole[axis].y;
    float grazing = dot(normal, ray);
    vec3 on_plane = across - ray * (dot(normal, across) / min(grazing, -1e-3 * length(ray)));
    vec4 moved = camera.clip_from_relative * vec4(on_plane, 0.0);
    pixels[axis] = length((moved.xy - clip.xy * (moved.w / clip.w)) / clip.w * 0.5 * vec2(camera.size));
  }
  return min(pixels / 1048576.0, 1.0);
}

vec2 importance(CameraData camera, float view_depth, Receiver r, vec3 map, Orientation o, WarpConstants constants) {
  vec2 product = vec2(1.0);
  if ((functions & importance_distance) != 0) product *= distance_to_eye(camera, view_depth);
  if ((functions & importance_normal) != 0) product *= surface_normal(r.normal, camera.eye - r.world, constants.normal_weight);
  if ((functions & importance_pixels) != 0) {
    vec3 ray = light_kind() == light_directional ? lookup.light_direction : r.world - lookup.light_position;
    product *= pixels_a_step(camera, r.world, r.normal, ray, map, o);
  }
  return product;
}
