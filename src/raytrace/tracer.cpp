#include "shadewright/raytrace/tracer.h"

#include "raytrace/queries.h"
#include "raytrace/ray_scene.h"

namespace shadewright {

struct Tracer::Impl {
  Impl(const Scene& from, double time) : scene(from, time) {}
  RayScene scene;
};

Tracer::Tracer(const Scene& scene, double time) : impl_(std::make_unique<Impl>(scene, time)) {}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

void Tracer::update(const Scene& scene, double time) {
  impl_->scene.update(scene, time);
}

std::vector<uint8_t> Tracer::visible(std::span<const SurfacePoint> points, const glm::vec3& eye, const Light& light,
                                     uint32_t row_length) const {
  return shadewright::visible(impl_->scene, points, eye, light, row_length);
}

std::vector<float> Tracer::visible_supersampled(std::span<const SurfacePoint> points, const PixelGrid& grid,
                                                const Light& light, uint32_t samples) const {
  return shadewright::visible_supersampled(impl_->scene, points, grid, light, samples);
}

std::vector<uint8_t> Tracer::unoccluded(std::span<const Segment> segments, uint32_t row_length) const {
  return shadewright::unoccluded(impl_->scene, segments, row_length);
}

std::vector<PrimaryHit> Tracer::primary(const PixelGrid& grid, double near) const {
  return shadewright::primary(impl_->scene, grid, near);
}

}  // namespace shadewright
