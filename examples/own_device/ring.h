// The procedural caster, written once for C++ (with GLM) and GLSL: a ring that floats above the ground. There is no
// vertex buffer; the position follows from the vertex's number alone.
const int ring_segments = 64;  // round the ring
const int ring_sides = 24;     // round its tube
const int ring_vertices = 6 * ring_segments * ring_sides;

// World position, metres. `place` is the ring's centre and its radius; the tube is a quarter of that.
vec3 ring_position(int vertex, vec4 place) {
  int cell = vertex / 6, corner = vertex % 6;
  // Two triangles a cell: corners 0 1 2 and 2 1 3 of its square.
  int k = corner < 3 ? corner : (corner == 3 ? 2 : (corner == 4 ? 1 : 3));
  int segment = (cell / ring_sides + k / 2) % ring_segments, side = (cell % ring_sides + k % 2) % ring_sides;
  float a = 6.2831853f * float(segment) / float(ring_segments), b = 6.2831853f * float(side) / float(ring_sides);
  float radius = place.w * (1.0f + 0.25f * cos(b));
  return vec3(place.x + radius * cos(a), place.y + 0.25f * place.w * sin(b), place.z + radius * sin(a));
}
