// 8-bit pictures in memory, and as PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace shadewright {

/// RGBA, row by row from the top, straight alpha, sRGB.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<glm::u8vec4> pixels;
};

/// InputError for what is not there or not a PNG.
Picture read_png(const std::filesystem::path& path);

/// The bytes of a PNG file, 8 bits a channel, without an alpha channel where every pixel is opaque. Quick (60 ms for
/// 1920x1080) rather than smallest.
std::vector<uint8_t> encode_png(const Picture& picture);

/// Writes `file` beside and renames; "-" is standard output. FailureError names the file.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Whether every pixel is opaque.
bool opaque(const Picture& picture);

}  // namespace shadewright
