#include "tile.h"

#include <algorithm>
#include <cmath>

namespace shadewright::voxel {

namespace {

/// The interval of texels of a row that lie inside of an edge, stepped from row to row without a division (exact).
/// With x = x0 + 256 i, edge(i) = e0 - 256 dy i >= least bounds i by floor((e0 - least) / (256 |dy|)).
class EdgeRows {
 public:
  EdgeRows(const EdgeFunction& edge, int64_t px, int64_t py) : dy_(edge.dy) {
    const int64_t value = edge.at(px, py) - edge.least;
    if (dy_ == 0) {
      quotient_ = value;
      step_ = kSubVoxels * edge.dx;
      return;
    }
    divisor_ = kSubVoxels * std::abs(dy_);
    divide(value, quotient_, rest_);
    divide(kSubVoxels * edge.dx, step_, step_rest_);
  }

  void narrow(int32_t& low, int32_t& high) const {
    if (dy_ == 0) {
      if (quotient_ < 0) high = -1;
    } else if (dy_ > 0) {
      high = int32_t(std::min<int64_t>(high, std::max<int64_t>(quotient_, -1)));
    } else {
      low = int32_t(std::max<int64_t>(low, std::min<int64_t>(-quotient_, kTileStride)));
    }
  }

  void next() {
    quotient_ += step_;
    rest_ += step_rest_;
    if (rest_ >= divisor_ && dy_ != 0) rest_ -= divisor_, ++quotient_;
  }

 private:
  void divide(int64_t value, int64_t& quotient, int64_t& rest) const {
    quotient = value / divisor_;
    rest = value % divisor_;
    if (rest < 0) rest += divisor_, --quotient;
  }

  int64_t dy_, quotient_ = 0, rest_ = 0, step_ = 0, step_rest_ = 0, divisor_ = 1;
};

/// floor(plane) is `exact_height` wherever the distance to the next integer exceeds `error`. Operations round by at
/// most 2^-53 relative each; the bound below counts them generously.
HeightPlane height_plane(const SnappedTriangle& t, int32_t x, int32_t y, uint32_t side) {
  const glm::dvec3 a(t.corners[0]);
  const glm::dvec2 slope = gradient(t);
  const double px = double(texel_center(x)) - a.x, py = double(texel_center(y)) - a.y,
               reach = double(side) * kSubVoxels;
  HeightPlane plane;
  plane.base = (a.z + slope.x * px + slope.y * py) / kSubVoxels + 0.5;
  plane.x = slope.x;  // per texel: 256 sub-voxels along x, 256 sub-voxels a voxel in z
  plane.y = slope.y;
  const double size =
      std::abs(a.z) + std::abs(slope.x) * (std::abs(px) + reach) + std::abs(slope.y) * (std::abs(py) + reach);
  plane.error = size / kSubVoxels * 0x1p-48 + 0x1p-40;
  return plane;
}

}  // namespace

/// Which texels of the widened tile the triangle covers; false if none.
bool TileRasterizer::find_rows(const SnappedTriangle& t, int32_t x, int32_t y) {
  const auto [low, high] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
  const int64_t side = this->side(), px = texel_center(x), py = texel_center(y), last = (side - 1) * kSubVoxels;
  // Rows whose centres lie in [low, high].
  const int64_t first = std::max<int64_t>(0, (low - py + kSubVoxels - 1) >> 8),
                end = std::min(side, ((high - py) >> 8) + 1);
  if (first >= end) return false;
  first_row_ = uint32_t(first), end_row_ = uint32_t(end);
  std::array<EdgeRows, 3> steps{EdgeRows({}, 0, 0), EdgeRows({}, 0, 0), EdgeRows({}, 0, 0)};
  size_t edges = 0;
  for (int e = 0; e < 3; ++e) {
    const EdgeFunction edge = edge_function(t, e);
    const int64_t corner = edge.at(px, py), along_x = -edge.dy * last, along_y = edge.dx * last;
    if (corner + std::max<int64_t>(along_x, 0) + std::max<int64_t>(along_y, 0) < edge.least) return false;
    if (corner + std::min<int64_t>(along_x, 0) + std::min<int64_t>(along_y, 0) >= edge.least) continue;
    steps[edges++] = EdgeRows(edge, px, py + first * kSubVoxels);
  }
  uint64_t any = 0;
  for (uint32_t j = first_row_; j < end_row_; ++j) {
    int32_t left = 0, right = int32_t(side) - 1;
    for (size_t e = 0; e < edges; ++e) {
      steps[e].narrow(left, right);
      steps[e].next();
    }
    rows_[j] = left > right ? 0 : (~uint64_t(0) >> (63 - right)) & (~uint64_t(0) << left);
    any |= rows_[j];
  }
  return any != 0;
}

TileRasterizer::Layer& TileRasterizer::layer_for(Crossing crossing) {
  for (size_t l = 0; l < used_layers_; ++l) {
    Layer& layer = layers_[l];
    if (layer.crossing != crossing) continue;
    uint64_t overlap = 0;
    for (uint32_t j = first_row_; j < end_row_; ++j) overlap |= layer.rows[j] & rows_[j];
    if (overlap == 0) return layer;
  }
  if (used_layers_ == layers_.size()) layers_.emplace_back();
  Layer& layer = layers_[used_layers_++];
  layer.crossing = crossing;
  layer.rows.fill(0);
  std::fill_n(layer.heights.begin(), side() * kTileStride, kNoHit);
  return layer;
}

void TileRasterizer::draw(const SnappedTriangle& triangle, int32_t x, int32_t y, Layer& layer) {
  TileRows uncertain;
  const HeightPlane plane = height_plane(triangle, x, y, side());
  if (plane.error < 0.25)
    fill_heights(plane, rows_, first_row_, end_row_, layer.heights.data(), uncertain);
  else
    uncertain = rows_;
  for (uint32_t j = first_row_; j < end_row_; ++j) {
    layer.rows[j] |= rows_[j];
    for (uint64_t bits = uncertain[j]; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      layer.heights[j * kTileStride + uint32_t(i)] =
          int32_t(exact_height(triangle, texel_center(x + i), texel_center(y + int64_t(j))));
    }
  }
}

void TileRasterizer::rasterize(std::span<const SnappedTriangle* const> triangles, int32_t x, int32_t y,
                               TileRanges& ranges) {
  const int32_t left = x - int32_t(rules_.reach), top = y - int32_t(rules_.reach);
  used_layers_ = 0;
  for (const SnappedTriangle* triangle : triangles)
    if (find_rows(*triangle, left, top)) draw(*triangle, left, top, layer_for(triangle->crossing));
  std::vector<LayerView> views;
  for (size_t l = 0; l < used_layers_; ++l) views.push_back({layers_[l].heights.data(), int32_t(layers_[l].crossing)});
  resolve_layers(views, side(), rules_.static_receivers, first_.data(), limit_.data());
  if (rules_.reach > 0) window_minimum(limit_.data(), side(), rules_.reach);
  for (uint32_t j = 0; j < kTileSide; ++j) {
    const int32_t* first = &first_[(j + rules_.reach) * kTileStride + rules_.reach];
    const int32_t* limit = &limit_[j * kTileStride];
    for (uint32_t i = 0; i < kTileSide; ++i) {
      const int32_t from = std::clamp(first[i], 0, rules_.depth);
      ranges.first[j * kTileSide + i] = from;
      ranges.limit[j * kTileSide + i] =
          std::clamp(limit[i] == kNoHit ? kNoHit : limit[i] - rules_.margin, from, rules_.depth);
    }
  }
}

}  // namespace shadewright::voxel
