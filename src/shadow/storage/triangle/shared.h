// What the look-up of a map of triangles reads besides the map, for C++ and GLSL.
#ifndef SHADEWRIGHT_TRIANGLE_SHARED_H
#define SHADEWRIGHT_TRIANGLE_SHARED_H

#ifdef __cplusplus
namespace shadewright::shared {
#endif

struct TriangleLookup {
  int reach;  // texels to each side whose triangles are tested
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
