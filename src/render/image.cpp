#include "shadewright/render/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright::render {

namespace {

constexpr glm::vec3 sun_radiance(3.0f, 2.85f, 2.55f), sky_zenith(0.32f, 0.46f, 0.72f), sky_horizon(0.72f, 0.80f, 0.88f),
    ground_bounce(0.16f, 0.14f, 0.12f);

/// Light that reaches a surface from everywhere but the light: a sky above, a darker ground below.
glm::vec3 ambient(const glm::vec3& normal) {
  return 0.55f * glm::mix(ground_bounce, glm::mix(sky_horizon, sky_zenith, 0.5f), 0.5f + 0.5f * normal.y);
}

uint8_t to_byte(float value) {
  return static_cast<uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

float srgb(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

/// Rolls highlights off smoothly (Reinhard, with white at 4).
float tone(float x) {
  return x * (1.0f + x / 16.0f) / (1.0f + x);
}

}  // namespace

std::vector<glm::vec3> shade(std::span<const SurfacePoint> points, std::span<const uint8_t> albedo,
                             std::span<const float> visibility, const Light& light, const Camera& camera) {
  std::vector<glm::vec3> radiance(points.size());
  const glm::vec3 direction(light.direction), position(light.position), eye(camera.eye);
  // A lamp is as bright as the sun at the distance of what the camera looks at.
  const float reference =
      light.kind == LightKind::directional ? 1.0f : static_cast<float>(glm::distance(light.position, camera.target));
  tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) {
    const SurfacePoint& point = points[i];
    if (!point.valid()) {
      radiance[i] = 0.9f * glm::mix(sky_horizon, sky_zenith, 0.35f);
      return;
    }
    const glm::vec3 color(glm::vec3(albedo[4 * i], albedo[4 * i + 1], albedo[4 * i + 2]) / 255.0f);
    const glm::vec3 to_light = light.kind == LightKind::directional ? -direction : position - point.position;
    const float distance = glm::length(to_light);
    const float falloff = light.kind == LightKind::directional ? 1.0f : reference * reference / (distance * distance);
    const float cosine = std::max(0.0f, glm::dot(point.normal, to_light) / distance);
    radiance[i] = color * (ambient(point.normal) + sun_radiance * (cosine * visibility[i] * std::min(falloff, 16.0f)));
  });
  return radiance;
}

Picture to_picture(std::span<const glm::vec3> radiance, uint32_t width, uint32_t height) {
  Picture picture{width, height, std::vector<glm::u8vec4>(radiance.size())};
  tbb::parallel_for(size_t{0}, radiance.size(), [&](size_t i) {
    const glm::vec3& c = radiance[i];
    picture.pixels[i] = {to_byte(srgb(tone(c.r))), to_byte(srgb(tone(c.g))), to_byte(srgb(tone(c.b))), 255};
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
