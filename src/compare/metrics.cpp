// The error figures of architecture section 6, from images alone; only the exception for features thinner than a texel
// asks the tracer. Sums are reduced in a fixed order, so that the figures do not depend on the number of threads.
#include "shadewright/compare/metrics.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "raytrace/light_ray.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

/// Pixels up to this far (Euclidean, centre to centre) from an edge pixel are the boundary; the rest is the interior.
constexpr int boundary_pixels = 3;

/// For a row that is |dy| away, how far an edge pixel may be along the row: floor(sqrt(boundary_pixels^2 - dy^2)).
constexpr std::array<uint8_t, boundary_pixels + 1> boundary_reach = {3, 2, 2, 0};

/// The exception samples this many points along each of the texel's two directions, one texel to each side: half a
/// texel apart.
constexpr int exception_samples = 5;
constexpr int exception_points = exception_samples * exception_samples;

/// Pixels whose exception is traced at once: bounds the memory, and is plenty for every core.
constexpr size_t exception_batch = 16384;

constexpr uint32_t rows_per_task = 16;

void require_size(std::string_view name, size_t size, size_t pixels, bool may_be_empty) {
  if (size == pixels || (may_be_empty && size == 0)) return;
  throw InputError("error metrics", fmt::format("`{}` has {} pixels and the image {}", name, size, pixels));
}

void require_sizes(const MetricsInput& input) {
  const size_t pixels = size_t{input.width} * input.height;
  require_size("facing", input.facing.size(), pixels, false);
  require_size("visibility", input.visibility.size(), pixels, false);
  require_size("reference", input.reference.size(), pixels, false);
  require_size("reference_filtered", input.reference_filtered.size(), pixels, true);
  require_size("oracle", input.oracle.size(), pixels, true);
  require_size("texel_u", input.texel_u.size(), pixels, true);
  require_size("texel_v", input.texel_v.size(), input.texel_u.size(), false);
  require_size("points", input.points.size(), pixels, input.texel_u.empty());
}

template <class Row>
void for_each_row(uint32_t height, const Row& row) {
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, height, rows_per_task), [&](const auto& range) {
    for (uint32_t y = range.begin(); y != range.end(); ++y) row(y);
  });
}

/// 1 for compared pixels that have a compared 4-neighbour of other reference visibility.
std::vector<uint8_t> find_edges(const MetricsInput& input) {
  const size_t width = input.width, height = input.height;
  std::vector<uint8_t> edge(width * height, 0);
  for_each_row(input.height, [&](uint32_t y) {
    for (size_t x = 0; x < width; ++x) {
      const size_t i = y * width + x;
      if (input.facing[i] == 0) continue;
      const auto differs = [&](size_t j) {
        return input.facing[j] != 0 && (input.reference[j] != 0) != (input.reference[i] != 0);
      };
      edge[i] = (x > 0 && differs(i - 1)) || (x + 1 < width && differs(i + 1)) || (y > 0 && differs(i - width)) ||
                (y + 1 < height && differs(i + width));
    }
  });
  return edge;
}

/// 1 within `boundary_pixels` of an edge pixel: the distance along each row first, then a disc out of seven rows.
std::vector<uint8_t> dilate(const std::vector<uint8_t>& edge, uint32_t width_pixels, uint32_t height_pixels) {
  const size_t width = width_pixels;
  const auto height = static_cast<int64_t>(height_pixels);
  constexpr uint8_t far_away = boundary_pixels + 1;
  std::vector<uint8_t> row_distance(edge.size(), far_away);
  for_each_row(height_pixels, [&](uint32_t y) {
    uint8_t* row = row_distance.data() + y * width;
    uint8_t distance = far_away;
    const auto step = [&](size_t x) {
      distance = edge[y * width + x] ? uint8_t{0} : std::min<uint8_t>(far_away, static_cast<uint8_t>(distance + 1));
      row[x] = std::min(row[x], distance);
    };
    for (size_t x = 0; x < width; ++x) step(x);
    distance = far_away;
    for (size_t x = width; x-- > 0;) step(x);
  });

  std::vector<uint8_t> boundary(edge.size(), 0);
  for_each_row(height_pixels, [&](uint32_t y) {
    uint8_t* row = boundary.data() + y * width;
    for (int dy = -boundary_pixels; dy <= boundary_pixels; ++dy) {
      const int64_t other = int64_t{y} + dy;
      if (other < 0 || other >= height) continue;
      const uint8_t* distance = row_distance.data() + static_cast<size_t>(other) * width;
      const uint8_t reach = boundary_reach[static_cast<size_t>(std::abs(dy))];
      for (size_t x = 0; x < width; ++x) row[x] |= distance[x] <= reach;
    }
  });
  return boundary;
}

struct Counts {
  uint64_t compared = 0, false_shadow = 0, false_lit = 0, oracle_wrong = 0, edge_pixels = 0;
  uint64_t boundary = 0, boundary_wrong = 0;
  double absolute = 0;
  std::vector<size_t> interior_wrong;  ///< pixels, ascending

  static Counts join(Counts a, const Counts& b) {
    a.compared += b.compared;
    a.false_shadow += b.false_shadow;
    a.false_lit += b.false_lit;
    a.oracle_wrong += b.oracle_wrong;
    a.edge_pixels += b.edge_pixels;
    a.boundary += b.boundary;
    a.boundary_wrong += b.boundary_wrong;
    a.absolute += b.absolute;
    a.interior_wrong.insert(a.interior_wrong.end(), b.interior_wrong.begin(), b.interior_wrong.end());
    return a;
  }
};

void count_pixel(const MetricsInput& input, size_t i, bool edge, bool boundary, Counts& counts) {
  if (input.facing[i] == 0) return;
  const bool truth = input.reference[i] != 0;
  const bool answer = lit(input.visibility[i]);
  const bool wrong = answer != truth;
  const float filtered = input.reference_filtered.empty() ? (truth ? 1.0f : 0.0f) : input.reference_filtered[i];
  counts.compared += 1;
  counts.false_shadow += wrong && truth;
  counts.false_lit += wrong && !truth;
  counts.oracle_wrong += !input.oracle.empty() && answer != (input.oracle[i] != 0);
  counts.edge_pixels += edge;
  counts.boundary += boundary;
  counts.boundary_wrong += boundary && wrong;
  counts.absolute += std::abs(double{input.visibility[i]} - double{filtered});
  if (wrong && !boundary) counts.interior_wrong.push_back(i);
}

Counts count(const MetricsInput& input, const std::vector<uint8_t>& edge, const std::vector<uint8_t>& boundary) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<uint32_t>(0, input.height, rows_per_task), Counts{},
      [&](const tbb::blocked_range<uint32_t>& rows, Counts counts) {
        const size_t end = size_t{rows.end()} * input.width;
        for (size_t i = size_t{rows.begin()} * input.width; i < end; ++i)
          count_pixel(input, i, edge[i] != 0, boundary[i] != 0, counts);
        return counts;
      },
      [](Counts a, const Counts& b) { return Counts::join(std::move(a), b); });
}

/// For each of `pixels`, whether the truth changes within one texel of its point: a feature the map cannot resolve. The
/// samples lie on the receiver's plane; the ones that leave a spot's cone say nothing about casters and are left out.
std::vector<uint8_t> truth_changes_within_texel(const MetricsInput& input, std::span<const size_t> pixels,
                                                const Tracer& tracer, const Light& light) {
  std::vector<SurfacePoint> samples(pixels.size() * exception_points);
  for (size_t p = 0; p < pixels.size(); ++p) {
    const size_t i = pixels[p];
    const SurfacePoint& point = input.points[i];
    for (int k = 0; k < exception_points; ++k) {
      const int row = k / exception_samples;
      // Half extents, hence -2..2 for one texel to each side.
      const auto a = static_cast<float>(k % exception_samples - 2), b = static_cast<float>(row - 2);
      SurfacePoint& sample = samples[p * exception_points + static_cast<size_t>(k)];
      sample.position = point.position + a * input.texel_u[i] + b * input.texel_v[i];
      const glm::vec3& q = sample.position;
      if (std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z)) sample.normal = point.normal;
    }
  }
  const std::vector<uint8_t> usable = facing_light(samples, light);
  const std::vector<uint8_t> visible = tracer.visible(samples, input.eye, light);
  std::vector<uint8_t> changes(pixels.size(), 0);
  for (size_t p = 0; p < pixels.size(); ++p) {
    bool any_lit = false, any_dark = false;
    for (size_t s = p * exception_points; s < (p + 1) * exception_points; ++s) {
      if (usable[s] == 0) continue;
      (visible[s] != 0 ? any_lit : any_dark) = true;
    }
    changes[p] = any_lit && any_dark;
  }
  return changes;
}

double ratio(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::vector<uint8_t> facing_light(std::span<const SurfacePoint> points, const Light& light) {
  std::vector<uint8_t> facing(points.size());
  const LightRay ray(light);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), 16384), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i)
      facing[i] = points[i].valid() && ray.reaches(points[i].position, points[i].normal, edge_on_cosine);
  });
  return facing;
}

ErrorFigures measure_error(const MetricsInput& input, const Tracer& tracer, const Light& light) {
  require_sizes(input);
  const std::vector<uint8_t> edge = find_edges(input);
  const std::vector<uint8_t> boundary = dilate(edge, input.width, input.height);
  const Counts counts = count(input, edge, boundary);

  ErrorFigures figures;
  figures.wrong = counts.false_shadow + counts.false_lit;
  figures.compared = counts.compared;
  figures.image_pixels = uint64_t{input.width} * input.height;
  figures.fraction = ratio(figures.wrong, figures.compared);
  figures.match = 1.0 - ratio(figures.wrong, figures.image_pixels);
  figures.false_shadow = counts.false_shadow;
  figures.false_lit = counts.false_lit;
  if (!input.oracle.empty()) figures.oracle_fraction = ratio(counts.oracle_wrong, counts.compared);
  figures.edge_pixels = counts.edge_pixels;
  figures.boundary_pixels = counts.boundary;
  figures.boundary_fraction = ratio(counts.boundary_wrong, counts.boundary);
  figures.mean_absolute = counts.compared == 0 ? 0.0 : counts.absolute / static_cast<double>(counts.compared);

  const std::span<const size_t> interior(counts.interior_wrong);
  for (size_t begin = 0; begin < interior.size(); begin += exception_batch) {
    const auto batch = interior.subspan(begin, std::min(exception_batch, interior.size() - begin));
    std::vector<uint8_t> excepted(batch.size(), 0);
    if (!input.texel_u.empty()) excepted = truth_changes_within_texel(input, batch, tracer, light);
    for (size_t p = 0; p < batch.size(); ++p) {
      if (excepted[p] != 0) continue;
      ++(input.reference[batch[p]] != 0 ? figures.interior_false_shadow : figures.interior_false_lit);
    }
  }
  return figures;
}

std::vector<uint8_t> wrong_pixels(const MetricsInput& input) {
  std::vector<uint8_t> wrong(input.visibility.size());
  for (size_t i = 0; i < wrong.size(); ++i)
    wrong[i] = input.facing[i] != 0 && lit(input.visibility[i]) != (input.reference[i] != 0);
  return wrong;
}

ErrorFigures total(std::span<const ErrorFigures> frames) {
  ErrorFigures sum;
  // Fractions are counts over counts: their counts are added, too.
  double oracle_wrong = 0, boundary_wrong = 0, absolute = 0;
  bool all_have_oracle = !frames.empty();
  for (const ErrorFigures& frame : frames) {
    const auto compared = static_cast<double>(frame.compared);
    sum.wrong += frame.wrong;
    sum.compared += frame.compared;
    sum.image_pixels += frame.image_pixels;
    sum.false_shadow += frame.false_shadow;
    sum.false_lit += frame.false_lit;
    sum.interior_false_shadow += frame.interior_false_shadow;
    sum.interior_false_lit += frame.interior_false_lit;
    sum.edge_pixels += frame.edge_pixels;
    sum.boundary_pixels += frame.boundary_pixels;
    all_have_oracle = all_have_oracle && frame.oracle_fraction.has_value();
    oracle_wrong += frame.oracle_fraction.value_or(0) * compared;
    boundary_wrong += frame.boundary_fraction * static_cast<double>(frame.boundary_pixels);
    absolute += frame.mean_absolute * compared;
  }
  const auto share = [](double part, uint64_t whole) { return whole == 0 ? 0.0 : part / static_cast<double>(whole); };
  sum.fraction = ratio(sum.wrong, sum.compared);
  sum.match = 1.0 - ratio(sum.wrong, sum.image_pixels);
  if (all_have_oracle) sum.oracle_fraction = share(oracle_wrong, sum.compared);
  sum.boundary_fraction = share(boundary_wrong, sum.boundary_pixels);
  sum.mean_absolute = share(absolute, sum.compared);
  return sum;
}

}  // namespace shadewright::compare
