#include "tile_simd.h"

#include <algorithm>

#include "sampling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voxel/tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadewright::voxel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kSide = 32;  // of a tile, texels

void FillHeights(const HeightPlane& plane, const TileRows& rows, uint32_t first_row, uint32_t end_row, int32_t* heights,
                 TileRows& uncertain) {
  const hn::CappedTag<double, 8> real;
  const hn::Rebind<int32_t, decltype(real)> whole;
  const uint32_t lanes = uint32_t(hn::Lanes(real));
  const auto error = hn::Set(real, plane.error), rest = hn::Set(real, 1.0 - plane.error), step = hn::Set(real, plane.x);
  const auto iota = hn::Iota(real, 0.0);
  for (uint32_t j = first_row; j < end_row; ++j) {
    const uint64_t row = rows[j];
    uint64_t doubtful = 0;
    const auto start = hn::Set(real, plane.base + plane.y * j);
    for (uint32_t i = row == 0 ? kTileStride : uint32_t(std::countr_zero(row)) / lanes * lanes; i < kTileStride;
         i += lanes) {
      const uint64_t bits = row >> i & ((uint64_t(1) << lanes) - 1);
      if (bits == 0) {
        if (row >> i == 0) break;
        continue;
      }
      const auto x = hn::Add(iota, hn::Set(real, double(i)));
      const auto height = hn::Add(start, hn::Mul(step, x));
      const auto floor = hn::Floor(height);
      const auto fraction = hn::Sub(height, floor);
      alignas(8) const std::array<uint8_t, 8> bytes{uint8_t(bits)};
      hn::BlendedStore(hn::DemoteTo(whole, floor), hn::LoadMaskBits(whole, bytes.data()), whole,
                       heights + j * kTileStride + i);
      const auto unsure = hn::Or(hn::Lt(fraction, error), hn::Gt(fraction, rest));
      if (!hn::AllFalse(real, unsure)) {
        std::array<uint8_t, 8> mask{};
        hn::StoreMaskBits(real, unsure, mask.data());
        doubtful |= (uint64_t(mask[0]) & bits) << i;
      }
    }
    uncertain[j] = doubtful;
  }
}

/// Where the entry counter of the closed layers is zero, at or behind `from`, lane by lane; only where `asked`.
template <class Tag, class Depths, class Asked>
Depths LeaveBodies(Tag d, std::span<const LayerView> layers, size_t i, Depths from, Asked asked) {
  const auto none = hn::Set(d, kNoHit), zero = hn::Zero(d);
  for (;;) {
    auto inside = zero;
    auto further = none;
    for (const LayerView& layer : layers) {
      if (layer.count == 0) continue;
      const auto height = hn::Load(d, layer.heights + i);
      const auto beyond = hn::Gt(height, from);
      inside = hn::Add(inside, hn::IfThenZeroElse(beyond, hn::Set(d, layer.count)));
      further = hn::Min(further, hn::IfThenElse(beyond, height, none));
    }
    const auto active = hn::And(hn::And(asked, hn::Ne(inside, zero)), hn::Ne(from, none));
    if (hn::AllFalse(d, active)) return from;
    from = hn::IfThenElse(active, further, from);
  }
}

void ResolveLayers(std::span<const LayerView> layers, uint32_t row_count, bool static_receivers, int32_t rest_from,
                   const RangeRows& ranges) {
  const hn::CappedTag<int32_t, 16> d;
  const size_t lanes = hn::Lanes(d), count = size_t(row_count) * kTileStride;
  const auto none = hn::Set(d, kNoHit), rest = hn::Set(d, rest_from);
  for (size_t i = 0; i < count; i += lanes) {
    auto nearest = none, second = none, first_open = none, first_closed = none;
    for (const LayerView& layer : layers) {
      const auto height = hn::Load(d, layer.heights + i);
      second = hn::Min(second, hn::Max(nearest, height));
      nearest = hn::Min(nearest, height);
      if (layer.count == 0)
        first_open = hn::Min(first_open, height);
      else
        first_closed = hn::Min(first_closed, height);
    }
    const auto entered = hn::Lt(first_closed, first_open);
    auto limit = nearest;
    if (!hn::AllFalse(d, entered))
      limit = hn::IfThenElse(entered, LeaveBodies(d, layers, i, first_closed, entered), limit);
    if (static_receivers) limit = hn::Max(limit, second);
    auto next_open = none, next_closed = none;
    for (const LayerView& layer : layers) {
      const auto height = hn::Load(d, layer.heights + i);
      const auto behind = hn::IfThenElse(hn::Gt(height, limit), height, none);
      if (layer.count == 0 || static_receivers)
        next_open = hn::Min(next_open, behind);
      else if (layer.count > 0)
        next_closed = hn::Min(next_closed, behind);
    }
    auto next = hn::Min(next_open, next_closed), next_limit = next;
    if (static_receivers) {
      next = limit;
    } else {
      const auto enters = hn::Lt(next_closed, next_open);
      if (!hn::AllFalse(d, enters))
        next_limit = hn::IfThenElse(enters, LeaveBodies(d, layers, i, next_closed, enters), next_open);
    }
    hn::Store(nearest, d, ranges.first + i);
    hn::Store(hn::Min(limit, rest), d, ranges.limit + i);
    hn::Store(hn::IfThenElse(hn::Lt(next, rest), next, none), d, ranges.next + i);
    hn::Store(hn::Min(next_limit, rest), d, ranges.next_limit + i);
  }
}

void RaisePinned(const RangeRows& ranges, uint32_t reach, int32_t margin, int32_t* least) {
  const hn::CappedTag<int32_t, 8> d;
  const size_t lanes = hn::Lanes(d), width = 2 * reach + 1;
  const auto slack = hn::Set(d, margin);
  for (size_t j = 0; j < kSide; ++j)
    for (size_t i = 0; i < kSide; i += lanes) {
      const auto first = hn::LoadU(d, ranges.first + (j + reach) * kTileStride + i + reach);
      const auto bound = hn::Load(d, least + j * kTileStride + i);
      // first + margin would overflow where there is no surface.
      if (hn::AllFalse(d, hn::Gt(first, hn::Sub(bound, slack)))) continue;
      auto raised = hn::Set(d, kNoHit);
      for (size_t y = 0; y < width; ++y)
        for (size_t x = 0; x < width; ++x) {
          const size_t at = (j + y) * kTileStride + i + x;
          const auto past = hn::Not(hn::Gt(hn::LoadU(d, ranges.next + at), first));
          raised = hn::Min(raised,
                           hn::IfThenElse(past, hn::LoadU(d, ranges.next_limit + at), hn::LoadU(d, ranges.limit + at)));
        }
      const auto own = hn::LoadU(d, ranges.limit + (j + reach) * kTileStride + i + reach);
      hn::Store(hn::Max(bound, hn::Min(raised, own)), d, least + j * kTileStride + i);
    }
}

void WindowMinimum(int32_t* values, uint32_t row_count, uint32_t reach) {
  const hn::CappedTag<int32_t, 16> d;
  const size_t lanes = hn::Lanes(d), width = 2 * reach + 1;
  // Windows of doubling width, then one more step to the exact width; in place, as every read is at or after the write.
  const auto fold = [&](size_t unit, size_t count) {
    for (size_t have = 1; have < width;) {
      const size_t step = std::min(have, width - have) * unit;
      size_t i = 0;
      for (; i + step + lanes <= count; i += lanes)
        hn::Store(hn::Min(hn::Load(d, values + i), hn::LoadU(d, values + i + step)), d, values + i);
      for (; i + step < count; ++i) values[i] = std::min(values[i], values[i + step]);
      have = std::min(2 * have, width);
    }
  };
  fold(1, size_t(row_count) * kTileStride);
  fold(kTileStride, size_t(row_count) * kTileStride);
}

void BlockRanges(const int32_t* first, const int32_t* limit, std::array<BlockRange, 16>& blocks) {
  const hn::CappedTag<int32_t, 8> d;
  const size_t lanes = hn::Lanes(d);
  for (size_t block = 0; block < 16; ++block) {
    const size_t corner = block / 4 * 8 * kSide + block % 4 * 8;
    auto first_max = hn::Set(d, INT32_MIN), limit_min = hn::Set(d, INT32_MAX);
    for (size_t row = 0; row < 8; ++row)
      for (size_t i = 0; i < 8; i += lanes) {
        first_max = hn::Max(first_max, hn::Load(d, first + corner + row * kSide + i));
        limit_min = hn::Min(limit_min, hn::Load(d, limit + corner + row * kSide + i));
      }
    blocks[block] = {hn::GetLane(hn::MaxOfLanes(d, first_max)), hn::GetLane(hn::MinOfLanes(d, limit_min))};
  }
}

uint32_t StabBlock(const int32_t* first, const int32_t* limit, std::array<Stab, 64>& stabs) {
  const hn::CappedTag<int32_t, 8> d;
  const size_t lanes = hn::Lanes(d);
  // The ranges that are left; pierced ones become [INT32_MIN, INT32_MAX], which neither bound minds.
  alignas(64) std::array<int32_t, 64> from, to;
  for (size_t row = 0; row < 8; ++row)
    for (size_t i = 0; i < 8; i += lanes) {
      hn::Store(hn::Load(d, first + row * kSide + i), d, &from[row * 8 + i]);
      hn::Store(hn::Load(d, limit + row * kSide + i), d, &to[row * 8 + i]);
    }
  const auto lowest = hn::Set(d, INT32_MIN), highest = hn::Set(d, INT32_MAX);
  uint32_t count = 0;
  for (uint64_t left = ~uint64_t(0); left != 0; ++count) {
    auto limit_min = highest;
    for (size_t i = 0; i < 64; i += lanes) limit_min = hn::Min(limit_min, hn::Load(d, &to[i]));
    const int32_t high = hn::GetLane(hn::MinOfLanes(d, limit_min));
    const auto depth = hn::Set(d, high);
    auto first_max = lowest;
    uint64_t pierced = 0;
    for (size_t i = 0; i < 64; i += lanes) {
      const auto begin = hn::Load(d, &from[i]);
      const auto hit = hn::Not(hn::Gt(begin, depth));
      first_max = hn::Max(first_max, hn::IfThenElse(hit, begin, lowest));
      hn::Store(hn::IfThenElse(hit, lowest, begin), d, &from[i]);
      hn::Store(hn::IfThenElse(hit, highest, hn::Load(d, &to[i])), d, &to[i]);
      std::array<uint8_t, 8> bits{};
      hn::StoreMaskBits(d, hit, bits.data());
      pierced |= uint64_t(bits[0]) << i;
    }
    pierced &= left;
    stabs[count] = {hn::GetLane(hn::MaxOfLanes(d, first_max)), high, pierced};
    left &= ~pierced;
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace shadewright::voxel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadewright::voxel {

HWY_EXPORT(FillHeights);
HWY_EXPORT(ResolveLayers);
HWY_EXPORT(WindowMinimum);
HWY_EXPORT(RaisePinned);
HWY_EXPORT(BlockRanges);
HWY_EXPORT(StabBlock);

void fill_heights(const HeightPlane& plane, const TileRows& rows, uint32_t first_row, uint32_t end_row,
                  int32_t* heights, TileRows& uncertain) {
  HWY_DYNAMIC_DISPATCH(FillHeights)(plane, rows, first_row, end_row, heights, uncertain);
}

void resolve_layers(std::span<const LayerView> layers, uint32_t row_count, bool static_receivers, int32_t rest_from,
                    const RangeRows& ranges) {
  HWY_DYNAMIC_DISPATCH(ResolveLayers)(layers, row_count, static_receivers, rest_from, ranges);
}

void raise_pinned(const RangeRows& ranges, uint32_t reach, int32_t margin, int32_t* least) {
  HWY_DYNAMIC_DISPATCH(RaisePinned)(ranges, reach, margin, least);
}

void window_minimum(int32_t* values, uint32_t row_count, uint32_t reach) {
  HWY_DYNAMIC_DISPATCH(WindowMinimum)(values, row_count, reach);
}

void block_ranges(const int32_t* first, const int32_t* limit, std::array<BlockRange, 16>& blocks) {
  HWY_DYNAMIC_DISPATCH(BlockRanges)(first, limit, blocks);
}

uint32_t stab_block(const int32_t* first, const int32_t* limit, std::array<Stab, 64>& stabs) {
  return HWY_DYNAMIC_DISPATCH(StabBlock)(first, limit, stabs);
}

}  // namespace shadewright::voxel
#endif
