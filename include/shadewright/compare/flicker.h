// `flicker` (architecture, section 6): how much of the error comes and goes from one frame to the next.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/scene.h"

namespace shadewright::compare {

/// What a camera saw in one frame. All images are grid.width x grid.height, row by row.
struct SeenFrame {
  double time = 0;  ///< seconds: where the scene's instances were
  PixelGrid grid;
  std::vector<SurfacePoint> points;
  std::vector<uint8_t> facing;      ///< 1 = compared (see `facing_light`)
  std::vector<uint32_t> instances;  ///< index into Scene::instances of what each pixel shows; ~0u = not known
};

/// Which instance each of `points` lies on, by a primary ray of `tracer` (at the time of the frame) through its pixel;
/// ~0u where the ray meets another surface than the device drew there (silhouettes).
std::vector<uint32_t> instances_seen(const Tracer& tracer, const PixelGrid& grid, double near,
                                     std::span<const SurfacePoint> points);

/// Pixels of another frame around a point, some perhaps twice; all ~0u = the point is not seen there.
using PixelsAround = std::array<uint32_t, 4>;

/// Where each point of `from` is seen in `to`. A point stays where it is on its instance: on a body that moved it is
/// followed (a shadow that keeps still on a car does not flicker, though the car drives). It falls between up to four
/// pixel centres of `to`; it is seen if it is compared itself, and each of them is compared and shows the same surface:
/// the same instance, with the point in the plane of that pixel's surface up to the float error of both and a tenth of
/// their distance (curved surfaces).
/// The frames' instances must be those of `scene`. InputError when an image has another size than its grid.
std::vector<PixelsAround> reproject(const Scene& scene, const SeenFrame& from, const SeenFrame& to);

struct FlickerCount {
  uint64_t points = 0;   ///< seen and compared in both frames
  uint64_t changed = 0;  ///< of those, wrong in one frame and right in the other

  FlickerCount& operator+=(const FlickerCount& other);
  double fraction() const { return points == 0 ? 0.0 : static_cast<double>(changed) / static_cast<double>(points); }
};

/// Counts the points of one frame (`wrong_from`, 0 or 1 a pixel) whose wrongness differs in the other (`wrong_to`),
/// where `around` comes from `reproject`. A point between pixels that disagree with each other lies at the border of
/// something wrong and can't be told: it has not changed. So a camera that moves over an error that keeps still counts
/// next to none, and a still camera gets the plain comparison of pixel with pixel.
///
/// Count both ways and add: a sliver of error thinner than a pixel is seen to appear only from its own frame, and to
/// vanish only from the frame before.
FlickerCount count_flicker(std::span<const PixelsAround> around, std::span<const uint8_t> wrong_from,
                           std::span<const uint8_t> wrong_to);

}  // namespace shadewright::compare
