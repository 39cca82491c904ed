// The blocks of a geometry stage between casters.vert and the rasterizer: with clip distances where casters are cut. Needs the
// parameterization before it.
#ifdef MAP_CUT
in gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
} gl_in[];
out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};
#endif
