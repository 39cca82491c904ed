#include "shadow/parameterization/perspective/shadowable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

namespace shadewright::shadow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// The light's window is divided into so many cells an axis: half as many where there are many casters, each of which
/// takes time in each cell.
constexpr int most_cells = 64;
constexpr size_t many_casters = 128;
/// What a sample counts that has no edges around it, as a share of the mean: bounds tell of edges roughly.
constexpr float least_edges = 0.1f;
/// Looking at more casters costs more than the texels are worth.
constexpr size_t most_casters = 8192;

/// Receivers on their way to the light, as convex bounds of where they pass.
class Sweep {
 public:
  Sweep(const Light& light, double slack)
      : directional_(light.kind == LightKind::directional),
        light_(directional_ ? -light.direction : light.position),
        per_direction_(1.0 / light_),
        slack_(slack) {}

  /// Whether `receivers` meet `caster` on the way.
  bool meets(const Box& caster, const Box& receivers) const {
    double from = 0, to = directional_ ? infinity : 1;
    for (int axis = 0; axis < 3; ++axis) {
      double low = receivers.min[axis] + slack_, high = receivers.max[axis] - slack_;
      if (low > high) {
        // Flat receivers are where their middle is. What lies in their plane casts nothing on them.
        const double middle = 0.5 * (low + high), velocity = directional_ ? light_[axis] : light_[axis] - middle;
        if (velocity > 0 ? caster.max[axis] < low : velocity < 0 && caster.min[axis] > high) return false;
        low = high = middle;
      }
      const double low_velocity = directional_ ? light_[axis] : light_[axis] - low;
      const double high_velocity = directional_ ? light_[axis] : light_[axis] - high;
      // low + t * velocity <= the caster's end, and the same for the other ends.
      const double until = (caster.max[axis] - low) * (directional_ ? per_direction_[axis] : 1 / low_velocity);
      const double since = (caster.min[axis] - high) * (directional_ ? per_direction_[axis] : 1 / high_velocity);
      if (low_velocity > 0)
        to = std::min(to, until);
      else if (low_velocity < 0)
        from = std::max(from, until);
      else if (low > caster.max[axis])
        return false;
      if (high_velocity > 0)
        from = std::max(from, since);
      else if (high_velocity < 0)
        to = std::min(to, since);
      else if (high < caster.min[axis])
        return false;
    }
    return from <= to;
  }

 private:
  bool directional_;
  glm::dvec3 light_, per_direction_;  ///< towards the light, or where it is
  double slack_;
};

/// A box in the shape whose extension takes the fewest instructions: lows and negative highs all become smaller.
struct Bounds {
  static constexpr float none = std::numeric_limits<float>::infinity();
  std::array<float, 8> ends{none, none, none, none, none, none, none, none};

  void extend(const Bounds& other) {
    for (size_t i = 0; i < 8; ++i) ends[i] = other.ends[i] < ends[i] ? other.ends[i] : ends[i];
  }
  Box box() const { return {{ends[0], ends[1], ends[2]}, {-ends[4], -ends[5], -ends[6]}}; }
};

Bounds bounds_of(const ReceiverBox& box) {
  return {{box.low.x, box.low.y, box.low.z, Bounds::none, -box.high.x, -box.high.y, -box.high.z, Bounds::none}};
}

struct Rectangle {
  glm::dvec2 low{infinity}, high{-infinity};
};

/// Bounds of a box as the light sees it: everything where part of it is not before the light.
Rectangle seen(const LightFrame& frame, const Box& box) {
  const glm::dmat4& view = frame.view_from_world;
  Rectangle result;
  if (!frame.perspective) {
    const glm::dvec3 center = box.center(), half = 0.5 * box.size();
    for (int axis = 0; axis < 2; ++axis) {
      const glm::dvec4 row = glm::row(view, axis);
      const double middle = glm::dot(row, glm::dvec4(center, 1)), reach = glm::dot(glm::abs(glm::dvec3(row)), half);
      result.low[axis] = middle - reach;
      result.high[axis] = middle + reach;
    }
    return result;
  }
  const glm::dvec2 window(frame.max_tangent);
  for (const glm::dvec3& corner : box.corners()) {
    const glm::dvec3 p(view * glm::dvec4(corner, 1));
    if (!(p.z < 0)) return {-window, window};
    const glm::dvec2 image = glm::clamp(glm::dvec2(p) / -p.z, -window, window);
    result.low = glm::min(result.low, image);
    result.high = glm::max(result.high, image);
  }
  return result;
}

/// A point as the light sees it.
glm::dvec2 seen(const LightFrame& frame, const glm::dvec3& point) {
  const glm::dvec3 p(frame.view_from_world * glm::dvec4(point, 1));
  if (!frame.perspective) return glm::dvec2(p);
  return glm::clamp(glm::dvec2(p) / std::max(-p.z, 1e-30), -glm::dvec2(frame.max_tangent),
                    glm::dvec2(frame.max_tangent));
}

/// In units of their mean.
void normalize_edges(std::vector<ReceiverSample>& samples) {
  float sum = 0;
  for (const ReceiverSample& sample : samples) sum += sample.edges;
  const float per_mean = static_cast<float>(samples.size()) / sum;
  const bool known = per_mean > 0 && std::isfinite(per_mean);
  for (ReceiverSample& sample : samples) sample.edges = known ? sample.edges * per_mean + least_edges : 1;
}

}  // namespace

bool keep_shadowable(Receivers& receivers, const Light& light, const LightFrame& frame, std::span<const Box> casters) {
  if (casters.size() > most_casters || receivers.boxes.empty()) return false;
  const int cells = casters.size() > many_casters ? most_cells / 2 : most_cells;
  Bounds all;
  Rectangle window;
  std::vector<Rectangle> images;
  images.reserve(receivers.boxes.size());
  for (const ReceiverBox& box : receivers.boxes) {
    all.extend(bounds_of(box));
    images.push_back(seen(frame, {glm::dvec3(box.low), glm::dvec3(box.high)}));
    window.low = glm::min(window.low, images.back().low);
    window.high = glm::max(window.high, images.back().high);
  }
  const Box all_box = all.box();
  const glm::dvec3 farthest = glm::max(glm::abs(all_box.min), glm::abs(all_box.max));
  const Sweep sweep(light, position_slack * (farthest.x + farthest.y + farthest.z + receivers.farthest));
  const glm::dvec2 extent = window.high - window.low;
  const auto per_unit = [&](double size) { return size > 0 && cells / size < infinity ? cells / size : 0.0; };
  const glm::dvec2 scale(per_unit(extent.x), per_unit(extent.y));
  const auto cell_of = [&](const glm::dvec2& p) {
    return glm::ivec2(glm::clamp(scale * (p - window.low), glm::dvec2(0), glm::dvec2(cells - 1)));
  };
  struct CellRange {
    glm::ivec2 first, last;
  };
  const auto cells_of = [&](const Rectangle& image) { return CellRange{cell_of(image.low), cell_of(image.high)}; };
  /// True if `use` says so for the place in the grid of one of the cells; it is asked no more then.
  const auto any_cell = [&](const CellRange& range, const auto& use) {
    for (int y = range.first.y; y <= range.last.y; ++y)
      for (int x = range.first.x; x <= range.last.x; ++x)
        if (use(static_cast<size_t>(y * cells + x))) return true;
    return false;
  };
  std::vector<Bounds> bounds(static_cast<size_t>(cells * cells));
  std::vector<CellRange> ranges;
  ranges.reserve(images.size());
  for (size_t i = 0; i < images.size(); ++i) {
    ranges.push_back(cells_of(images[i]));
    const Bounds box = bounds_of(receivers.boxes[i]);
    any_cell(ranges.back(), [&](size_t cell) {
      bounds[cell].extend(box);
      return false;
    });
  }
  // Cells that hold receivers and are not known to be covered.
  std::array<bool, most_cells * most_cells> open, covered{};
  // How much of casters' silhouettes is expected in each: about as much as the bounds' have sides, anywhere within.
  std::array<float, most_cells * most_cells> edges{};
  const glm::dvec2 cell_size = extent / static_cast<double>(cells);
  for (size_t cell = 0; cell < bounds.size(); ++cell) open[cell] = !bounds[cell].box().empty();
  for (const Box& caster : casters) {
    if (!sweep.meets(caster, all_box)) continue;
    const Rectangle image = seen(frame, caster);
    if (glm::any(glm::greaterThan(image.low, window.high)) || glm::any(glm::lessThan(image.high, window.low))) continue;
    const glm::dvec2 size = image.high - image.low, spread = size + cell_size;
    const auto density = static_cast<float>((size.x + size.y) / (spread.x * spread.y));
    any_cell(cells_of(image), [&](size_t cell) {
      edges[cell] += density;
      if (open[cell] && sweep.meets(caster, bounds[cell].box())) {
        open[cell] = false;
        covered[cell] = true;
      }
      return false;
    });
  }
  const auto is_covered = [&](size_t cell) { return covered[cell]; };
  size_t kept = 0;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (any_cell(ranges[i], is_covered)) receivers.boxes[kept++] = receivers.boxes[i];
  const bool left_out = kept < images.size();
  receivers.boxes.resize(kept);
  size_t kept_samples = 0;
  for (const ReceiverSample& sample : receivers.samples) {
    const glm::ivec2 at = cell_of(seen(frame, sample.world));
    const auto cell = static_cast<size_t>(at.y * cells + at.x);
    if (left_out && !covered[cell]) continue;
    // Of the edges of bodies as close as this some hide others.
    receivers.samples[kept_samples++] = {sample.world, sample.normal, std::sqrt(edges[cell])};
  }
  receivers.samples.resize(kept_samples);
  normalize_edges(receivers.samples);
  return left_out;
}

}  // namespace shadewright::shadow
