// Casters whose edges bend in the warped map: vertices in flat coordinates for bent.geom.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/rectilinear.glsl"
#include "render/scene_vertex.glsl"

layout(push_constant, scalar) uniform Push { uint view; };

void main() { gl_Position = map_caster_flat(scene_world_position(), view); }
