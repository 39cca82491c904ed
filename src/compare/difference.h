// What is wrong, as a picture to lay over the scene.
#pragma once

#include "shadewright/compare/metrics.h"
#include "shadewright/image/picture.h"

namespace shadewright::compare {

inline constexpr glm::u8vec4 false_shadow_color{230, 38, 52, 255};
inline constexpr glm::u8vec4 false_lit_color{33, 118, 255, 255};

/// False shadow red, false lit blue, everything else transparent: what TechniqueResult::difference names.
Picture difference_picture(const MetricsInput& input);

}  // namespace shadewright::compare
