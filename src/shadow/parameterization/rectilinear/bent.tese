// Corners of a tessellated triangle, in the homogeneous flat coordinates in which it is flat.
#version 460

layout(triangles, equal_spacing) in;

void main() {
  // Precise: along an edge the same for both of its triangles, in whatever order its ends come.
  precise vec4 p = gl_TessCoord.x * gl_in[0].gl_Position + gl_TessCoord.y * gl_in[1].gl_Position + gl_TessCoord.z * gl_in[2].gl_Position;
  gl_Position = p;
}
