// The vertex inputs of everything that draws the scene (see scene_vertex_input in culled_draws.cpp).
layout(location = 0) in vec3 position_mesh;
layout(location = 1) in vec4 world_from_mesh_row_x;
layout(location = 2) in vec4 world_from_mesh_row_y;
layout(location = 3) in vec4 world_from_mesh_row_z;
layout(location = 4) in uint cluster_first_triangle;
layout(location = 5) in vec4 instance_albedo;

vec3 scene_world_position() {
  vec4 p = vec4(position_mesh, 1.0);
  return vec3(dot(world_from_mesh_row_x, p), dot(world_from_mesh_row_y, p), dot(world_from_mesh_row_z, p));
}
