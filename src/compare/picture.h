// 8-bit RGBA images in memory, and as PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace shadewright::compare {

/// Row by row from the top, straight alpha, sRGB.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<glm::u8vec4> pixels;
};

/// InputError for what is not there or not a PNG.
Picture read_png(const std::filesystem::path& path);

/// The file's bytes, 8 bits a channel, without an alpha channel where every pixel is opaque. Quick (60 ms for
/// 1920x1080) rather than smallest.
std::vector<uint8_t> encode_png(const Picture& picture);

/// `picture` without what it shares with `base`: transparent there. To be laid over `base`, which must be opaque and of
/// the same size, as `picture` must.
Picture delta(const Picture& picture, const Picture& base);

/// Whether `delta(picture, base)` is defined.
bool has_delta(const Picture& picture, const Picture& base);

}  // namespace shadewright::compare
