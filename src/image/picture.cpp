#include "shadewright/image/picture.h"

#include <png.h>

#include <algorithm>
#include <span>

#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright {
namespace {

static_assert(sizeof(glm::u8vec4) == 4, "pixels are handed to libpng as they are");

/// libpng's simplified interface, freed whatever happens.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

bool opaque(const Picture& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(), [](const glm::u8vec4& p) { return p.a == 255; });
}

Picture read_png(const std::filesystem::path& path) {
  PngImage png;
  Picture picture;
  const auto require = [&](int success) {
    if (success == 0) throw InputError(path.string(), "cannot be read as PNG (" + std::string(png.message) + ")");
  };
  require(png_image_begin_read_from_file(&png, path.c_str()));
  png.format = PNG_FORMAT_RGBA;
  picture.width = png.width;
  picture.height = png.height;
  picture.pixels.resize(size_t{png.width} * png.height);
  require(png_image_finish_read(&png, nullptr, picture.pixels.data(), 0, nullptr));
  return picture;
}

std::vector<uint8_t> encode_png(const Picture& picture) {
  PngImage png;
  png.width = picture.width;
  png.height = picture.height;
  png.flags = PNG_IMAGE_FLAG_FAST;
  png.format = PNG_FORMAT_RGBA;
  const void* pixels = picture.pixels.data();
  std::vector<uint8_t> rgb;
  if (opaque(picture)) {
    png.format = PNG_FORMAT_RGB;
    rgb.reserve(picture.pixels.size() * 3);
    for (const glm::u8vec4& p : picture.pixels) rgb.insert(rgb.end(), {p.r, p.g, p.b});
    pixels = rgb.data();
  }
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<uint8_t> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
    throw FailureError("PNG", "a picture cannot be encoded (" + std::string(png.message) + ")");
  bytes.resize(size);
  return bytes;
}

void write_png(const Picture& picture, const std::filesystem::path& file) {
  const std::vector<uint8_t> png = encode_png(picture);
  const auto bytes = std::as_bytes(std::span(png));
  if (file == "-")
    write_standard_output(bytes);
  else
    write_file(file, bytes);
}

}  // namespace shadewright
