// How far a float surface point may lie from its true plane: one number for C++ and GLSL. See position_error (raytrace).
#ifndef SHADEWRIGHT_GEOMETRY_POSITION_ERROR_H
#define SHADEWRIGHT_GEOMETRY_POSITION_ERROR_H

#ifdef __cplusplus
namespace shadewright {
inline
#endif
    const float position_error_scale = 16.0f / 16777216.0f;  // 16 * 2^-24
#ifdef __cplusplus
}  // namespace shadewright
#endif
#endif
