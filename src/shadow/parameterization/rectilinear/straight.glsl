// By less than this, in texels, an edge's image may leave the straight line between its ends and be drawn as one without more ado,
// where casters are not cut. The receivers' tolerance (rectilinear.glsl) allows for it.
#ifndef SHADEWRIGHT_RECTILINEAR_STRAIGHT_GLSL
#define SHADEWRIGHT_RECTILINEAR_STRAIGHT_GLSL
const float straight_texels = 1.0 / 64.0;
const float snapping_texels = 1.0 / 256.0;  // what the rasterizer rounds vertices to
#endif
