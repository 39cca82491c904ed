// The error of several techniques on many cameras and lights of one scene, whose device copy and tracer are kept.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "compare/difference.h"
#include "render/closed_bodies.h"
#include "shadewright/compare/metrics.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::compare {

class PairErrors {
 public:
  PairErrors(const gpu::Device& device, const Scene& scene, uint32_t width, uint32_t height,
             const std::vector<std::string>& specs)
      : device_(device),
        width_(width),
        height_(height),
        scene_(device, scene),
        tracer_(scene),
        seen_(scene),
        camera_pass_(scene_, width, height, false) {
    for (const Mesh& mesh : scene.meshes) closed_.push_back(render::mesh_topology(mesh).closed);
    for (const std::string& spec : specs)
      techniques_.push_back(shadow::make_technique(device, shadow::parse_spec(spec), {width, height, 1, true}));
  }

  struct Result {
    ErrorFigures error;
    shadow::Counters counters;
    /// Of the pixels that differ from the oracle those that do so wherever within a step of the rasterizer's grid of
    /// vertices, 1/256 texel, from the texel's centre the oracle looks.
    uint64_t beyond_snapping = 0;
    Picture picture;  ///< the truth, what differs from it coloured
  };
  /// One result a technique.
  std::vector<Result> run(const Camera& camera, const Light& light) {
    shadow::Frame frame;
    frame.scene = &scene_;
    frame.camera = render::make_view(camera, camera.near, width_, height_);
    frame.light = light;
    {
      gpu::Recorder recorder(device_);
      camera_pass_.record(recorder, frame.camera);
      recorder.finish();
    }
    const auto points = camera_pass_.surface_points(frame.camera);
    frame.depth = camera_pass_.depth().view();
    frame.normal = camera_pass_.normal().view();
    const std::vector<uint8_t> facing = facing_light(points, light);
    const std::vector<uint8_t> reference = tracer_.visible(points, glm::vec3(camera.eye), light, width_);
    std::vector<Result> results;
    for (const auto& technique : techniques_) {
      gpu::Recorder recorder(device_);
      technique->prepare(frame, recorder);
      technique->record(frame, recorder);
      recorder.finish();
      std::vector<float> visibility;
      for (const std::byte value : gpu::read_back(device_, technique->visibility(), 1))
        visibility.push_back(static_cast<float>(std::to_integer<uint8_t>(value)) / 255.0f);
      const auto rays = technique->oracle_rays(frame);
      const std::vector<uint8_t> oracle = free_segments(rays->origins, facing, light);
      MetricsInput input;
      input.width = width_;
      input.height = height_;
      input.points = points;
      input.eye = glm::vec3(camera.eye);
      input.facing = facing;
      input.visibility = visibility;
      input.reference = reference;
      input.oracle = oracle;
      input.texel_u = rays->texel_u;
      input.texel_v = rays->texel_v;
      results.push_back({measure_error(input, tracer_, light), technique->counters(),
                         beyond_snapping(*rays, input, light), picture(input)});
    }
    return results;
  }

  /// Of what the camera sees the share that is the inner side of a closed body: in free space it sees none.
  double inner_share(const Camera& camera) const {
    const PixelGrid grid{width_, height_, camera};
    const std::vector<PrimaryHit> hits = tracer_.primary(grid, camera.near);
    double seen = 0, inner = 0;
    for (uint32_t i = 0; i < hits.size(); ++i) {
      const PrimaryHit& hit = hits[i];
      if (!(hit.distance > 0)) continue;
      seen += 1;
      const Instance& instance = seen_.instances[hit.instance];
      if (closed_[instance.mesh][hit.triangle] == 0) continue;
      const Mesh& mesh = seen_.meshes[instance.mesh];
      const glm::uvec3& corners = mesh.triangles[hit.triangle];
      const auto corner = [&](uint32_t v) { return glm::dvec3(mesh.positions[v]); };
      // The mesh's own outward normal; dot(normal, ray) keeps its sign in the mesh's space.
      const glm::dvec3 outwards =
          glm::cross(corner(corners.y) - corner(corners.x), corner(corners.z) - corner(corners.x));
      const glm::dvec3 ray = grid.ray(i % width_ + 0.5, i / width_ + 0.5);
      inner += glm::dot(outwards, glm::inverse(glm::dmat3(transform_at(seen_, instance, 0))) * ray) > 0;
    }
    return seen > 0 ? inner / seen : 0;
  }

 private:
  std::vector<uint8_t> free_segments(const std::vector<glm::vec3>& origins, const std::vector<uint8_t>& facing,
                                     const Light& light) const {
    std::vector<Segment> segments(origins.size());
    for (size_t i = 0; i < origins.size(); ++i) {
      if (facing[i] == 0 || !std::isfinite(origins[i].x)) continue;
      if (light.kind == LightKind::directional)
        segments[i] = {origins[i], std::numeric_limits<float>::infinity(), -glm::vec3(light.direction), 1};
      else
        segments[i] = {origins[i], 1.0f, glm::vec3(light.position) - origins[i], 1};
    }
    return tracer_.unoccluded(segments, width_);
  }

  /// Grey as surfaces are turned to the camera: bright where lit, dark where the light does not reach.
  static Picture picture(const MetricsInput& input) {
    Picture picture = difference_picture(input);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
      if (picture.pixels[i].a > 0) continue;
      const SurfacePoint& point = input.points[i];
      const glm::vec3 from_eye = point.position - input.eye;
      const float turned = point.valid() ? std::abs(glm::dot(point.normal, from_eye)) / glm::length(from_eye) : 0;
      const float light = input.facing[i] == 0 ? 30 : input.reference[i] == 0 ? 60 : 150;
      const auto grey = static_cast<uint8_t>(point.valid() ? light * (0.7f + turned) : 0);
      picture.pixels[i] = glm::u8vec4(grey, grey, grey, 255);
    }
    return picture;
  }

  uint64_t beyond_snapping(const shadow::OracleRays& rays, const MetricsInput& input, const Light& light) const {
    std::vector<uint8_t> differs(input.oracle.size());
    for (size_t i = 0; i < differs.size(); ++i)
      differs[i] = input.facing[i] != 0 && lit(input.visibility[i]) != (input.oracle[i] != 0);
    for (int direction = 0; direction < 8; ++direction) {
      const double angle = 0.25 * std::numbers::pi * direction;
      const auto u = static_cast<float>(2 * std::cos(angle) / 256), v = static_cast<float>(2 * std::sin(angle) / 256);
      std::vector<glm::vec3> moved = rays.origins;
      for (size_t i = 0; i < moved.size(); ++i) moved[i] += u * rays.texel_u[i] + v * rays.texel_v[i];  // half extents
      const std::vector<uint8_t> answer = free_segments(moved, differs, light);
      for (size_t i = 0; i < moved.size(); ++i)
        differs[i] = differs[i] != 0 && (answer[i] != 0) == (input.oracle[i] != 0);
    }
    return static_cast<uint64_t>(std::count(differs.begin(), differs.end(), uint8_t{1}));
  }

  const gpu::Device& device_;
  uint32_t width_, height_;
  render::SceneGpu scene_;
  Tracer tracer_;
  const Scene& seen_;
  std::vector<std::vector<uint8_t>> closed_;  ///< by mesh and triangle
  render::CameraPass camera_pass_;
  std::vector<std::unique_ptr<shadow::Technique>> techniques_;
};

}  // namespace shadewright::compare
