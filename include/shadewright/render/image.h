// Pictures on the CPU: a simple lit image by which a person can judge shadows, and PNG and EXR files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/scene.h"

namespace shadewright::render {

/// 8-bit picture, rows from top to bottom; 1 channel (grey) or 3 (sRGB).
struct Picture {
  uint32_t width = 0, height = 0, channels = 3;
  std::vector<uint8_t> data;
};

/// Linear radiance of each point: the light where `visibility` (0..1) lets it, ambient from the sky, a sky behind. `albedo` is
/// linear RGBA8 a pixel. Sizes: width * height each.
std::vector<glm::vec3> shade(std::span<const SurfacePoint> points, std::span<const uint8_t> albedo, std::span<const float> visibility,
                             const Light& light, const Camera& camera);

/// Linear radiance to a display picture (sRGB).
Picture to_picture(std::span<const glm::vec3> radiance, uint32_t width, uint32_t height);
/// Visibility 0..1 to grey.
Picture to_picture(std::span<const float> visibility, uint32_t width, uint32_t height);

/// The bytes of a PNG file.
std::vector<uint8_t> encode_png(const Picture& picture);
/// Writes `file` beside and renames; "-" is standard output. FailureError names the file.
void write_png(const Picture& picture, const std::filesystem::path& file);
/// Linear radiance (R, G, B) and visibility (channel "visibility") as 32-bit float EXR, written beside and renamed.
void write_exr(std::span<const glm::vec3> radiance, std::span<const float> visibility, uint32_t width, uint32_t height,
               const std::filesystem::path& file);

}  // namespace shadewright::render
