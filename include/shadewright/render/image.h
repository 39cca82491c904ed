// A simple lit image by which a person can judge shadows, as a picture and as EXR.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "shadewright/image/picture.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/scene.h"

namespace shadewright::render {

/// How far from a lamp the picture is as bright as under the sun: at what the camera looks at. 0 for a sun.
float lamp_distance(const Light& light, const Camera& camera);

/// Linear radiance of each point: the light where `visibility` (0..1) lets it, ambient from the sky, a sky behind.
/// `albedo` is linear RGBA8 a pixel. Sizes: width * height each.
std::vector<glm::vec3> shade(std::span<const SurfacePoint> points, std::span<const uint8_t> albedo,
                             std::span<const float> visibility, const Light& light, const Camera& camera);

/// Linear radiance to a display picture (sRGB).
Picture to_picture(std::span<const glm::vec3> radiance, uint32_t width, uint32_t height);
/// Visibility 0..1 to grey.
Picture to_picture(std::span<const float> visibility, uint32_t width, uint32_t height);

/// Linear radiance (R, G, B) and visibility (channel "visibility") as 32-bit float EXR, written beside and renamed.
void write_exr(std::span<const glm::vec3> radiance, std::span<const float> visibility, uint32_t width, uint32_t height,
               const std::filesystem::path& file);

}  // namespace shadewright::render
