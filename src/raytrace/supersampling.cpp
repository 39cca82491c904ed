// Visibility of the light over a pixel's footprint: sample positions in the pixel are carried along the camera's rays
// to the tangent plane of the pixel's surface point.
#include "raytrace/light_ray.h"
#include "raytrace/occlusion_packet.h"
#include "raytrace/pixel_rays.h"
#include "raytrace/queries.h"

namespace shadewright {
namespace {

// Radians that a point's normal may be off: twice 16-bit octahedral (3.5e-5 each), as the camera pass stores it. It
// tilts the tangent plane, which at a grazing view reaches far.
constexpr float normal_error = 0x1p-13f;

// Two independent scrambles of a pixel's samples, from a 64-bit mix of its index (MurmurHash3's finalizer).
glm::uvec2 scramble(uint64_t pixel) {
  uint64_t h = pixel + 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
  h ^= h >> 33;
  return {static_cast<uint32_t>(h), static_cast<uint32_t>(h >> 32)};
}

uint32_t reverse_bits(uint32_t v) {
  v = (v >> 16) | (v << 16);
  v = ((v & 0xff00ff00u) >> 8) | ((v & 0x00ff00ffu) << 8);
  v = ((v & 0xf0f0f0f0u) >> 4) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v & 0xccccccccu) >> 2) | ((v & 0x33333333u) << 2);
  return ((v & 0xaaaaaaaau) >> 1) | ((v & 0x55555555u) << 1);
}

uint32_t sobol_second(uint32_t i) {
  uint32_t result = 0;
  for (uint32_t v = 1u << 31; i != 0; i >>= 1, v ^= v >> 1)
    if (i & 1) result ^= v;
  return result;
}

// Sample `i` of a pixel relative to its centre, in [-0.5, 0.5)^2: the (0,2)-sequence of van der Corput and Sobol' with
// random digit scrambling (Kollig and Keller 2002, "Efficient multidimensional sampling"). Any 2^m samples are
// stratified in every elementary interval of area 2^-m.
glm::dvec2 sample_offset(uint32_t i, const glm::uvec2& scramble) {
  return {(reverse_bits(i) ^ scramble.x) * 0x1p-32 - 0.5, (sobol_second(i) ^ scramble.y) * 0x1p-32 - 0.5};
}

// The plane through a surface point, seen from the camera. A ray d of unit view depth meets it at view depth 1/q with
// q = dot(d, normal) / dot(position - eye, normal), linear in the image position.
class TangentPlane {
 public:
  TangentPlane(const PixelRays& rays, const SurfacePoint& point) : rays_(rays), position_(point.position) {
    const glm::dvec3 normal(point.normal), from_eye = position_ - rays.eye;
    const double distance = glm::dot(from_eye, normal);
    center_ = from_eye / glm::dot(from_eye, rays.forward);
    edge_on_ = distance == 0;
    if (edge_on_) return;
    inverse_depth_ = glm::dot(center_, normal) / distance;
    gradient_ = glm::dvec2(glm::dot(rays.step_x, normal), glm::dot(rays.step_y, normal)) / distance;
  }

  // The point of the plane under the pixel's centre moved by `offset` pixels. Near the plane's horizon (seen edge-on)
  // the offset is shortened so that the sample's depth stays within a factor of 2 of the centre's: it stays on the
  // plane and in the pixel.
  glm::dvec3 at(glm::dvec2 offset) const {
    if (edge_on_) return position_;
    const double change = glm::dot(gradient_, offset);
    const double limit = (change < 0 ? -0.5 : 1.0) * inverse_depth_;
    if (std::abs(change) > std::abs(limit)) offset *= limit / change;
    const double depth = 1.0 / (inverse_depth_ + glm::dot(gradient_, offset));
    return rays_.eye + depth * (center_ + offset.x * rays_.step_x + offset.y * rays_.step_y);
  }

 private:
  const PixelRays& rays_;
  glm::dvec3 position_, center_;
  glm::dvec2 gradient_{0.0};
  double inverse_depth_ = 0;
  bool edge_on_ = false;
};

}  // namespace

std::vector<float> visible_supersampled(const RayScene& scene, std::span<const SurfacePoint> points,
                                        const PixelGrid& grid, const Light& light, uint32_t samples) {
  std::vector<float> result(points.size(), 0.0f);
  const PixelRays rays(grid);
  const LightRay ray(light);
  const glm::vec3 eye(rays.eye);
  for_each_packet(Tiling(points.size(), grid.width), [&](const PacketIndices& pixels) {
    for (uint32_t p = 0; p < pixels.count; ++p) {
      const size_t pixel = pixels.index[p];
      const SurfacePoint& point = points[pixel];
      if (!point.valid()) continue;
      const TangentPlane plane(rays, point);
      const glm::uvec2 scrambled = scramble(pixel);
      uint32_t lit = 0;
      for (uint32_t first = 0; first < samples; first += packet_size) {
        OcclusionPacket packet;
        for (uint32_t lane = 0; lane < std::min(packet_size, samples - first); ++lane) {
          const glm::vec3 position(plane.at(sample_offset(first + lane, scrambled)));
          if (!ray.reaches(position, point.normal)) continue;
          // Occluders nearer to the sample than the sample is to the pixel's point do not count: so far the tangent
          // plane stands in for the surface, and in a concave edge it lies below it.
          const float reach = glm::distance(position, point.position);
          glm::vec3 origin = position + point.normal * (position_error(position, eye) + normal_error * reach);
          origin += reach * glm::normalize(glm::vec3(ray.towards(origin)));
          packet.set(lane, origin, glm::vec3(ray.towards(origin)), ray.length());
        }
        packet.trace(scene);
        for (uint32_t lane = 0; lane < packet_size; ++lane) lit += packet.active(lane) && packet.free(lane);
      }
      result[pixel] = static_cast<float>(lit) / static_cast<float>(samples);
    }
  });
  return result;
}

}  // namespace shadewright
