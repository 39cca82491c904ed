#include "shadow/parameterization/perspective/shadowable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

namespace shadewright::shadow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// What float surface points are off by, as a share of their coordinates and distance, with room.
constexpr double position_slack = 4e-6;
/// The light's window is divided into so many cells an axis.
constexpr int cells = 32;
/// Looking at more casters costs more than the texels are worth.
constexpr size_t most_casters = 8192;

/// Whether `receivers`, moving towards the light, meet `caster` on the way: convex bounds of both against each other.
bool may_shadow(const Box& caster, const Box& receivers, const Light& light, double slack) {
  double from = 0, to = light.kind == LightKind::directional ? infinity : 1;
  // low + t * velocity <= limit
  const auto require = [&](double low, double velocity, double limit) {
    if (velocity > 0)
      to = std::min(to, (limit - low) / velocity);
    else if (velocity < 0)
      from = std::max(from, (limit - low) / velocity);
    else if (low > limit)
      to = -infinity;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double low = receivers.min[axis] + slack, high = receivers.max[axis] - slack;
    const bool directional = light.kind == LightKind::directional;
    require(low, directional ? -light.direction[axis] : light.position[axis] - low, caster.max[axis]);
    require(-high, directional ? light.direction[axis] : high - light.position[axis], -caster.min[axis]);
  }
  return from <= to;
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

}  // namespace

bool keep_shadowable(Receivers& receivers, const Light& light, const LightFrame& frame, std::span<const Box> casters) {
  if (casters.size() > most_casters || receivers.boxes.empty()) return false;
  Box all;
  Rectangle window;
  std::vector<Rectangle> images;
  images.reserve(receivers.boxes.size());
  for (const ReceiverBox& box : receivers.boxes) {
    all.extend(box.world);
    images.push_back(seen(frame, box.world));
    window.low = glm::min(window.low, images.back().low);
    window.high = glm::max(window.high, images.back().high);
  }
  const glm::dvec3 farthest = glm::max(glm::abs(all.min), glm::abs(all.max));
  const double slack = position_slack * (farthest.x + farthest.y + farthest.z + receivers.farthest);
  const glm::dvec2 extent = window.high - window.low;
  const auto per_unit = [](double size) { return size > 0 && cells / size < infinity ? cells / size : 0.0; };
  const glm::dvec2 scale(per_unit(extent.x), per_unit(extent.y));
  struct CellRange {
    glm::ivec2 first, last;
  };
  const auto cells_of = [&](const Rectangle& image) {
    const glm::dvec2 end(cells - 1);
    return CellRange{glm::ivec2(glm::clamp(scale * (image.low - window.low), glm::dvec2(0), end)),
                     glm::ivec2(glm::clamp(scale * (image.high - window.low), glm::dvec2(0), end))};
  };
  struct Cell {
    Box receivers;
    bool covered = false;
  };
  std::array<Cell, cells * cells> grid;
  /// True if `use` says so for one of the cells; it is asked no more then.
  const auto any_cell = [&](const CellRange& range, const auto& use) {
    for (int y = range.first.y; y <= range.last.y; ++y)
      for (int x = range.first.x; x <= range.last.x; ++x)
        if (use(grid[static_cast<size_t>(y * cells + x)])) return true;
    return false;
  };
  std::vector<CellRange> ranges;
  ranges.reserve(images.size());
  for (size_t i = 0; i < images.size(); ++i) {
    ranges.push_back(cells_of(images[i]));
    any_cell(ranges.back(), [&](Cell& at) {
      at.receivers.extend(receivers.boxes[i].world);
      return false;
    });
  }
  for (const Box& caster : casters) {
    if (!may_shadow(caster, all, light, slack)) continue;
    const Rectangle image = seen(frame, caster);
    if (glm::any(glm::greaterThan(image.low, window.high)) || glm::any(glm::lessThan(image.high, window.low))) continue;
    any_cell(cells_of(image), [&](Cell& at) {
      at.covered = at.covered || (!at.receivers.empty() && may_shadow(caster, at.receivers, light, slack));
      return false;
    });
  }
  const auto covered = [](const Cell& at) { return at.covered; };
  size_t kept = 0;
  for (size_t i = 0; i < ranges.size(); ++i)
    if (any_cell(ranges[i], covered)) receivers.boxes[kept++] = receivers.boxes[i];
  const bool left_out = kept < images.size();
  receivers.boxes.resize(kept);
  if (left_out)
    std::erase_if(receivers.samples, [&](const ReceiverSample& sample) {
      return !any_cell(cells_of(seen(frame, {sample.world, sample.world})), covered);
    });
  return left_out;
}

}  // namespace shadewright::shadow
