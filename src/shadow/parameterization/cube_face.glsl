// The face of a point light's cube that looks along `direction`: +X -X +Y -Y +Z -Z.
uint cube_face(vec3 direction) {
  vec3 a = abs(direction);
  if (a.x >= a.y && a.x >= a.z) return direction.x >= 0.0 ? 0 : 1;
  if (a.y >= a.z) return direction.y >= 0.0 ? 2 : 3;
  return direction.z >= 0.0 ? 4 : 5;
}
