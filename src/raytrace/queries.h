// The queries that Tracer offers, against a RayScene: tests reach both kinds of scene through them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/ray_scene.h"
#include "shadewright/raytrace/tracer.h"

namespace shadewright {

std::vector<uint8_t> visible(const RayScene& scene, std::span<const SurfacePoint> points, const glm::vec3& eye,
                             const Light& light, uint32_t row_length);

std::vector<float> visible_supersampled(const RayScene& scene, std::span<const SurfacePoint> points,
                                        const PixelGrid& grid, const Light& light, uint32_t samples);

std::vector<uint8_t> unoccluded(const RayScene& scene, std::span<const Segment> segments, uint32_t row_length);

std::vector<PrimaryHit> primary(const RayScene& scene, const PixelGrid& grid, double near);

}  // namespace shadewright
