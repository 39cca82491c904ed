// Four pixels of the camera's depth buffer at once. Needs `camera` and `camera_depth` before it.

// Which pixels camera_quad tells of, relative to the first.
const ivec2 quad_pixels[4] = ivec2[4](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));

// Where the samplers' gathering finds them: the corner between them.
vec2 quad_corner(ivec2 first) { return vec2(first + 1) / vec2(camera.size); }

// Depths of the pixels from `first` on, which lies in the image; the background's beyond it.
vec4 camera_quad(ivec2 first) {
  vec4 depths = textureGather(camera_depth, quad_corner(first));
  ivec2 size = ivec2(camera.size);
  if (first.x + 1 >= size.x) depths.yz = vec2(camera.background_depth);
  if (first.y + 1 >= size.y) depths.xy = vec2(camera.background_depth);
  return depths;
}
