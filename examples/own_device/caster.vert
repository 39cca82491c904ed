// Draws the ring into a shadow map, whatever map that is: only the #include names the parameterization.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOOKUP_SET 0  // where the pipeline has Technique::lookup_layout()
#include "shadow/parameterization/uniform/uniform.glsl"
#include "ring.h"

layout(push_constant, scalar) uniform Push {
  vec4 place;
  uint view;
};

void main() { gl_Position = map_caster(ring_position(gl_VertexIndex, place), view); }
