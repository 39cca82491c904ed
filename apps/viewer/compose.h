// What compose.frag is told, for C++ and GLSL.
#ifndef SHADEWRIGHT_VIEWER_COMPOSE_H
#define SHADEWRIGHT_VIEWER_COMPOSE_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace shadewright::viewer::shared {
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
#endif

const uint show_lit = 0, show_visibility = 1, show_wrong = 2;

struct ComposeConstants {
  vec4 light;           // world: towards a sun (w = 0), or where a lamp is (w = 1)
  float lamp_distance;  // see render/shading.h
  float divider;        // pixels from the left edge: the right side's answer is shown beyond it
  uint show;
  uint answered;                 // bit 0: the left side has an answer, bit 1: the right one
  float least_cosine;            // of a surface that is compared
  vec3 false_shadow, false_lit;  // colours of wrong pixels, sRGB
};

#ifdef __cplusplus
}  // namespace shadewright::viewer::shared
#endif
#endif
