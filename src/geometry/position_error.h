// The bound of a surface point's float error, for C++ and GLSL alike. Derived in raytrace/position_error.cpp.
#ifndef SHADEWRIGHT_GEOMETRY_POSITION_ERROR_H
#define SHADEWRIGHT_GEOMETRY_POSITION_ERROR_H

#ifdef __cplusplus
namespace shadewright {
inline constexpr
#else
const
#endif
    float position_error_of_coordinates = 8.0f / 16777216.0f;  // a metre of |x| + |y| + |z|, in metres
#ifdef __cplusplus
inline constexpr
#else
const
#endif
    float position_error_of_distance = 32.0f / 16777216.0f;  // a metre from the eye, in metres
#ifdef __cplusplus
}  // namespace shadewright
#endif
#endif
