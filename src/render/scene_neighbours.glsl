// For geometry shaders that draw the scene: what lies across a triangle's edges. Needs render/shared.h.
// gl_PrimitiveIDIn counts within a cluster, gl_InstanceIndex goes through from the vertex shader.
layout(set = 0, binding = 0, scalar) readonly buffer ScenePositions { vec3 scene_positions[]; };
layout(set = 0, binding = 1, scalar) readonly buffer SceneNeighbours { uvec3 scene_neighbours[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SceneVisible { VisibleInstance scene_visible[]; };
const uint no_vertex = 0xffffffffu;

// The place, in the world, of a vertex of the mesh that `instance` shows.
vec3 scene_vertex_world(VisibleInstance instance, uint vertex) {
  vec4 p = vec4(scene_positions[vertex], 1.0);
  return vec3(dot(instance.world_from_mesh_rows[0], p), dot(instance.world_from_mesh_rows[1], p),
              dot(instance.world_from_mesh_rows[2], p));
}
