#include "shadewright/render/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/shading.h"
#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright::render {

namespace {

uint8_t to_byte(float value) {
  return static_cast<uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

float lamp_distance(const Light& light, const Camera& camera) {
  return light.kind == LightKind::directional ? 0.0f : static_cast<float>(glm::distance(light.position, camera.target));
}

std::vector<glm::vec3> shade(std::span<const SurfacePoint> points, std::span<const uint8_t> albedo,
                             std::span<const float> visibility, const Light& light, const Camera& camera) {
  std::vector<glm::vec3> radiance(points.size());
  const glm::vec3 direction(light.direction), position(light.position);
  const bool sun = light.kind == LightKind::directional;
  const float lamp_distance = render::lamp_distance(light, camera);
  tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) {
    const SurfacePoint& point = points[i];
    const glm::vec3 color(glm::vec3(albedo[4 * i], albedo[4 * i + 1], albedo[4 * i + 2]) / 255.0f);
    radiance[i] = point.valid()
                      ? shared::surface_radiance(color, point.normal, sun ? -direction : position - point.position,
                                                 lamp_distance, visibility[i])
                      : shared::background_radiance();
  });
  return radiance;
}

Picture to_picture(std::span<const glm::vec3> radiance, uint32_t width, uint32_t height) {
  Picture picture{width, height, std::vector<glm::u8vec4>(radiance.size())};
  tbb::parallel_for(size_t{0}, radiance.size(), [&](size_t i) {
    const glm::vec3& c = radiance[i];
    picture.pixels[i] = {to_byte(shared::displayed(c.r)), to_byte(shared::displayed(c.g)),
                         to_byte(shared::displayed(c.b)), 255};
  });
  return picture;
}

Picture to_picture(std::span<const float> visibility, uint32_t width, uint32_t height) {
  Picture picture{width, height, std::vector<glm::u8vec4>(visibility.size())};
  std::transform(visibility.begin(), visibility.end(), picture.pixels.begin(), [](float v) {
    const uint8_t grey = to_byte(v);
    return glm::u8vec4(grey, grey, grey, 255);
  });
  return picture;
}

void write_exr(std::span<const glm::vec3> radiance, std::span<const float> visibility, uint32_t width, uint32_t height,
               const std::filesystem::path& file) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    try {
      Imf::Header header(static_cast<int>(width), static_cast<int>(height));
      Imf::FrameBuffer pixels;
      const auto add = [&](const char* name, const float* first, size_t stride) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        // OpenEXR takes a char* also for what it only reads.
        auto* base = const_cast<char*>(reinterpret_cast<const char*>(first));
        pixels.insert(name, Imf::Slice(Imf::FLOAT, base, stride, stride * width));
      };
      add("R", &radiance[0].x, sizeof(glm::vec3));
      add("G", &radiance[0].y, sizeof(glm::vec3));
      add("B", &radiance[0].z, sizeof(glm::vec3));
      add("visibility", visibility.data(), sizeof(float));
      Imf::OutputFile output(temporary.string().c_str(), header);
      output.setFrameBuffer(pixels);
      output.writePixels(static_cast<int>(height));
    } catch (const std::exception& error) {
      throw FailureError(file.string(), std::string("can't be written (") + error.what() + ")",
                         "check that its folder exists and the disk has room");
    }
  });
}

}  // namespace shadewright::render
