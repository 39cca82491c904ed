// Many look-ups at once (CPVS, section 6.2), a point a vector lane.
//
// A filter's leaves share their path down to the node in which they part. All points first walk that shared part; most
// end there, in a volume that is visible or shadowed as a whole. Each other point goes on as one task a leaf, from the
// node where its leaves parted: what the paper reaches by backtracking in the best of its orders (figure 7), without a
// stack.
#include "batch.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "lookup.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voxel/batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "voxel/batch_points.h"

HWY_BEFORE_NAMESPACE();
namespace shadewright::voxel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint32_t, 16>;
using Word = hn::Vec<Words>;
using Reals = hn::CappedTag<double, 8>;
using Real = hn::Vec<Reals>;

/// Voxels of the receivers: see `LightGrid::receiver_voxel`.
void FindReceivers(const ReceiverMap& map, PointBlock& block) {
  const Reals d;
  const hn::Rebind<float, Reals> narrow;
  const hn::Rebind<int32_t, Reals> whole;
  const auto set = [&](double value) { return hn::Set(d, value); };
  const auto row = [&](const std::array<double, 4>& m, Real x, Real y, Real z) {
    return hn::Add(hn::Add(hn::Mul(set(m[0]), x), hn::Mul(set(m[1]), y)), hn::Add(hn::Mul(set(m[2]), z), set(m[3])));
  };
  // Far outside of every volume, but not of the integers.
  const auto lowest = set(-1e6), highest = set(4e6);
  for (size_t i = 0; i < block.count; i += hn::Lanes(d)) {
    const auto load = [&](const float* values) { return hn::PromoteTo(d, hn::Load(narrow, values + i)); };
    Real px = load(block.position[0].data()), py = load(block.position[1].data()), pz = load(block.position[2].data());
    Real nx = load(block.normal[0].data()), ny = load(block.normal[1].data()), nz = load(block.normal[2].data());
    const auto unknown = hn::Eq(hn::Add(hn::Add(hn::Abs(nx), hn::Abs(ny)), hn::Abs(nz)), hn::Zero(d));
    nx = hn::IfThenElse(unknown, set(map.towards_light[0]), nx);
    ny = hn::IfThenElse(unknown, set(map.towards_light[1]), ny);
    nz = hn::IfThenElse(unknown, set(map.towards_light[2]), nz);
    const Real lx = hn::Abs(row(map.light[0], nx, ny, nz)), ly = hn::Abs(row(map.light[1], nx, ny, nz)),
               lz = hn::Abs(row(map.light[2], nx, ny, nz));
    Real across = hn::Add(hn::Mul(set(map.reach_x), lx), hn::Mul(set(map.reach_y), ly)),
         along = hn::Mul(set(map.reach_z), lz);
    if (map.spot) {
      const Real w = row(map.voxel[3], px, py, pz);
      across = hn::Mul(across, w);
      along = hn::Mul(along, hn::Mul(w, w));
    }
    // A receiver without a normal has only its own depth to leave.
    const Real offset = hn::Add(hn::IfThenElse(unknown, hn::Zero(d), across), along);
    px = hn::Add(px, hn::Mul(nx, offset));
    py = hn::Add(py, hn::Mul(ny, offset));
    pz = hn::Add(pz, hn::Mul(nz, offset));
    const Real w = map.spot ? row(map.voxel[3], px, py, pz) : set(1.0);
    const auto store = [&](size_t axis, Real value) {
      value = map.spot ? hn::Div(value, w) : value;
      // Not a number, or behind a spot: outside.
      const auto inside = hn::And(hn::And(hn::Gt(value, lowest), hn::Lt(value, highest)), hn::Gt(w, hn::Zero(d)));
      hn::Store(hn::DemoteTo(whole, hn::Floor(hn::IfThenElse(inside, value, lowest))), whole,
                reinterpret_cast<int32_t*>(block.voxel[axis].data()) + i);
    };
    const Real z = row(map.voxel[2], px, py, pz);
    store(0, row(map.voxel[0], px, py, pz));
    store(1, row(map.voxel[1], px, py, pz));
    store(2, hn::IfThenElse(hn::Ge(z, hn::Mul(highest, w)), hn::Mul(set(3e6), w),
                            z));  // behind the volume: the last voxel
  }
}

Word GatherWords(Words d, const uint32_t* base, Word index) {
  return hn::GatherIndex(d, base, hn::BitCast(hn::RebindToSigned<Words>(), index));
}

/// One step down: the code of the child at the bits, and where its node is if it has one.
struct Step {
  Word code, at;
};

template <class OctantMask>
Step Descend(Words d, const uint32_t* nodes, Word at, Word child, OctantMask octants) {
  const Word one = hn::Set(d, 1), three = hn::Set(d, 3);
  const Word header = GatherWords(d, nodes, at);
  const Word code = hn::And(hn::Shr(header, hn::Add(child, child)), three);
  const Word owner = hn::IfThenElse(hn::And(octants, hn::Eq(code, three)), hn::And(child, three), child);
  const Word own = hn::AndNot(hn::Add(header, header), hn::And(header, hn::Set(d, 0xaaaa)));
  const Word upto = hn::Sub(hn::Shl(hn::Set(d, 4), hn::Add(owner, owner)), one);
  const Word index = hn::PopulationCount(hn::And(own, upto));  // one more than among the pointers: the header
  const auto inner = hn::Gt(code, one);
  return {code, GatherWords(d, nodes, hn::IfThenElseZero(inner, hn::Add(at, index)))};
}

/// Walks every point to where its leaves part, or to the end. Ended points get a result; the others' place is left in
/// `block.at` and `block.height`, 0 = not even one cell of the grid holds all their leaves.
void WalkTogether(const DagView& dag, uint32_t reach, uint32_t depth, PointBlock& block) {
  const Words d;
  const uint32_t top = dag.log2_size - dag.log2_grid;
  const Word one = hn::Set(d, 1), zero = hn::Zero(d), wide = hn::Set(d, reach),
             last = hn::Set(d, (1u << dag.log2_size) - 1);
  const uint32_t* nodes = dag.nodes.data();
  for (size_t i = 0; i < block.count; i += hn::Lanes(d)) {
    const Word x = hn::Load(d, &block.voxel[0][i]), y = hn::Load(d, &block.voxel[1][i]);
    const hn::RebindToSigned<Words> si;
    const auto deep = hn::BitCast(si, hn::Load(d, &block.voxel[2][i]));
    const Word z = hn::Min(hn::BitCast(d, hn::Max(deep, hn::Zero(si))), hn::Set(d, depth - 1));
    // Unsigned, a coordinate before zero is beyond the end.
    const auto before = hn::MaskFromVec(hn::BitCast(d, hn::VecFromMask(si, hn::Lt(deep, hn::Zero(si)))));
    const Word x0 = hn::Sub(x, wide), x1 = hn::Add(x, wide), y0 = hn::Sub(y, wide), y1 = hn::Add(y, wide);
    const auto whole =
        hn::Not(hn::Or(hn::Or(hn::Gt(x0, x1), hn::Gt(x1, last)), hn::Or(hn::Gt(y0, y1), hn::Gt(y1, last))));
    const Word apart = hn::Or(hn::Xor(x0, x1), hn::Xor(y0, y1));  // from its highest bit down the leaves' paths differ
    auto active = hn::AndNot(before, hn::And(whole, hn::Eq(hn::ShiftRightSame(apart, int(top)), zero)));
    Word cell = hn::Add(hn::ShiftLeftSame(hn::ShiftRightSame(z, int(top)), int(2 * dag.log2_grid)),
                        hn::Add(hn::ShiftLeftSame(hn::ShiftRightSame(y0, int(top)), int(dag.log2_grid)),
                                hn::ShiftRightSame(x0, int(top))));
    Word at = GatherWords(d, dag.grid.data(), hn::IfThenElseZero(active, cell));
    Word value = hn::IfThenElse(before, one, at), height = hn::IfThenElseZero(active, hn::Set(d, top));
    const auto decided = hn::AndNot(hn::Gt(at, one), active);
    auto ended = hn::Or(before, decided);
    active = hn::AndNot(decided, active);
    for (uint32_t bit = top; bit-- > kSlabHeight;) {
      active = hn::And(active, hn::Eq(hn::ShiftRightSame(apart, int(bit)), zero));
      if (hn::AllFalse(d, active)) break;
      const auto bit_of = [&](Word v) { return hn::And(hn::ShiftRightSame(v, int(bit)), one); };
      const Word child = hn::Add(bit_of(x0), hn::Add(hn::Add(bit_of(y0), bit_of(y0)), hn::ShiftLeft<2>(bit_of(z))));
      const Step step = Descend(d, nodes, hn::IfThenElseZero(active, at), child, hn::Eq(one, one));
      const auto uniform = hn::AndNot(hn::Gt(step.code, one), active);
      value = hn::IfThenElse(uniform, step.code, value);
      ended = hn::Or(ended, uniform);
      active = hn::AndNot(uniform, active);
      at = hn::IfThenElse(active, step.at, at);
      height = hn::IfThenElse(active, hn::Set(d, bit), height);
    }
    hn::Store(at, d, &block.at[i]);
    hn::Store(hn::IfThenElse(ended, hn::Set(d, kEnded), height), d, &block.height[i]);
    hn::Store(value, d, &block.value[i]);
    hn::Store(z, d, &block.voxel[2][i]);
  }
}

/// Walks single leaves to their end, and counts the visible voxels of each that the filter holds.
void WalkLeaves(const DagView& dag, uint32_t reach, LeafTasks& tasks) {
  const Words d;
  const hn::RebindToSigned<Words> si;
  const uint32_t* nodes = dag.nodes.data();
  static constexpr std::array<uint64_t, 1> kNone{};
  const auto* leaves = reinterpret_cast<const uint32_t*>(dag.leaves.empty() ? kNone.data() : dag.leaves.data());
  const Word one = hn::Set(d, 1), slab = hn::Set(d, kSlabHeight), seven = hn::Set(d, 7);
  for (size_t i = 0; i < tasks.count; i += hn::Lanes(d)) {
    const Word x = hn::Load(d, &tasks.x[i]), y = hn::Load(d, &tasks.y[i]), z = hn::Load(d, &tasks.z[i]);
    Word at = hn::Load(d, &tasks.at[i]), height = hn::Load(d, &tasks.height[i]), value = one;
    auto active = hn::Lt(hn::Iota(d, 0), hn::Set(d, uint32_t(std::min<size_t>(tasks.count - i, hn::Lanes(d)))));
    auto in_leaf = hn::AndNot(active, active);
    while (!hn::AllFalse(d, active)) {
      const auto octants = hn::Gt(height, slab);
      const Word bit = hn::IfThenElseZero(active, hn::Sub(height, one));
      const auto bit_of = [&](Word v) { return hn::And(hn::Shr(v, bit), one); };
      const Word octant = hn::Add(bit_of(x), hn::Add(hn::Add(bit_of(y), bit_of(y)), hn::ShiftLeft<2>(bit_of(z))));
      const Step step = Descend(d, nodes, hn::IfThenElseZero(active, at),
                                hn::IfThenElse(octants, octant, hn::And(z, seven)), octants);
      const auto uniform = hn::AndNot(hn::Gt(step.code, one), active);
      value = hn::IfThenElse(uniform, step.code, value);
      active = hn::AndNot(uniform, active);
      at = hn::IfThenElse(active, step.at, at);
      in_leaf = hn::Or(in_leaf, hn::AndNot(octants, active));
      active = hn::And(active, octants);
      height = hn::Sub(height, one);
    }
    const Word index = hn::IfThenElseZero(in_leaf, hn::Add(at, at)), filled = hn::Sub(hn::Zero(d), value);
    const Word low = hn::IfThenElse(in_leaf, hn::GatherIndex(d, leaves, hn::BitCast(si, index)), filled);
    const Word high = hn::IfThenElse(in_leaf, hn::GatherIndex(d, leaves + 1, hn::BitCast(si, index)), filled);
    // The filter's columns and rows inside the leaf (figure 6), as one byte of columns and two masks of four rows.
    const Word px = hn::Load(d, &tasks.center_x[i]), py = hn::Load(d, &tasks.center_y[i]), wide = hn::Set(d, reach);
    const auto first = [&](Word center, Word corner) {
      return hn::Sub(hn::Max(hn::Sub(center, wide), corner), corner);
    };
    const auto end = [&](Word center, Word corner) {
      return hn::Min(hn::Sub(hn::Add(hn::Add(center, wide), one), corner), hn::Set(d, 8));
    };
    const auto from = [&](Word bit) { return hn::Shl(hn::Set(d, 0xff), bit); };
    const Word columns = hn::And(hn::AndNot(from(end(px, x)), from(first(px, x))), hn::Set(d, 0xff));
    const Word pattern = hn::Mul(columns, hn::Set(d, 0x01010101));
    // In two shifts, as a shift by all 32 bits is not defined.
    const auto rows_from = [&](Word row) {
      const Word twice = hn::ShiftLeft<2>(row);
      return hn::Shl(hn::Shl(hn::Set(d, ~0u), twice), twice);
    };
    const Word top = first(py, y), bottom = end(py, y), four = hn::Set(d, 4);
    const auto below_four = [&](Word row) { return hn::Min(row, four); };
    const auto above_four = [&](Word row) { return hn::Sub(hn::Max(row, four), four); };
    const Word low_rows = hn::AndNot(rows_from(below_four(bottom)), rows_from(below_four(top)));
    const Word high_rows = hn::AndNot(rows_from(above_four(bottom)), rows_from(above_four(top)));
    const auto lit = [&](Word leaf, Word rows) { return hn::PopulationCount(hn::And(leaf, hn::And(pattern, rows))); };
    hn::Store(hn::Add(lit(low, low_rows), lit(high, high_rows)), d, &tasks.lit[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace shadewright::voxel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadewright::voxel {

HWY_EXPORT(FindReceivers);
HWY_EXPORT(WalkTogether);
HWY_EXPORT(WalkLeaves);

namespace {

ReceiverMap receiver_map(const LightGrid& light, uint32_t taps) {
  ReceiverMap map;
  map.spot = light.kind == LightKind::spot;
  const double slack = 1.0 / 32;  // as LightGrid::receiver_offset
  map.reach_x = (0.5 * taps + slack) * light.texel_size.x;
  map.reach_y = (0.5 * taps + slack) * light.texel_size.y;
  map.reach_z = (0.5 + slack) * light.depth_at_unit_distance();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      map.voxel[size_t(row)][size_t(column)] = light.voxel_from_world[column][row];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      map.light[size_t(row)][size_t(column)] = light.light_from_world[column][row];
    map.towards_light[size_t(row)] = -light.light_from_world[row][2];
  }
  return map;
}

/// Any voxel, window borders and coarse cells included: for the few points that the vectors leave.
float filtered_alone(const DagView& dag, glm::ivec3 at, uint32_t taps) {
  const int32_t last = int32_t(1u << dag.log2_size) - 1, reach = int32_t(taps / 2);
  const int32_t x0 = std::max(at.x - reach, 0), x1 = std::min(at.x + reach, last);
  const int32_t y0 = std::max(at.y - reach, 0), y1 = std::min(at.y + reach, last);
  if (x0 > x1 || y0 > y1) return 1.0f;
  uint32_t inside = 0, lit = 0;
  for (int32_t y = y0 >> 3; y <= y1 >> 3; ++y)
    for (int32_t x = x0 >> 3; x <= x1 >> 3; ++x) {
      const uint64_t mask = filter_mask(x, y, x0, x1, y0, y1);
      inside += uint32_t(std::popcount(mask));
      lit += uint32_t(std::popcount(mask & find_leaf(dag, uint32_t(x) * 8, uint32_t(y) * 8, uint32_t(at.z))));
    }
  return float(lit + taps * taps - inside) / float(taps * taps);
}

/// Puts the leaves of a point's filter into the list.
void add_leaves(const PointBlock& block, uint32_t point, int32_t reach, LeafTasks& tasks) {
  const int32_t x = int32_t(block.voxel[0][point]), y = int32_t(block.voxel[1][point]);
  for (int32_t leaf_y = (y - reach) >> 3; leaf_y <= (y + reach) >> 3; ++leaf_y)
    for (int32_t leaf_x = (x - reach) >> 3; leaf_x <= (x + reach) >> 3; ++leaf_x) {
      const size_t task = tasks.count++;
      tasks.x[task] = uint32_t(leaf_x) * 8;
      tasks.y[task] = uint32_t(leaf_y) * 8;
      tasks.z[task] = block.voxel[2][point];
      tasks.at[task] = block.at[point];
      tasks.height[task] = block.height[point];
      tasks.center_x[task] = uint32_t(x);
      tasks.center_y[task] = uint32_t(y);
      tasks.point[task] = point;
    }
}

void finish_tasks(const DagView& dag, uint32_t reach, LeafTasks& tasks, std::array<uint32_t, kBlockPoints>& lit) {
  HWY_DYNAMIC_DISPATCH(WalkLeaves)(dag, reach, tasks);
  for (size_t i = 0; i < tasks.count; ++i) lit[tasks.point[i]] += tasks.lit[i];
  tasks.count = 0;
}

void look_up_block(const DagView& dag, const ReceiverMap& map, uint32_t depth, std::span<const SurfacePoint> points,
                   uint32_t taps, std::span<float> result) {
  PointBlock block;
  LeafTasks tasks;
  std::array<uint32_t, kBlockPoints> lit{};
  block.load(points);
  HWY_DYNAMIC_DISPATCH(FindReceivers)(map, block);
  HWY_DYNAMIC_DISPATCH(WalkTogether)(dag, taps / 2, depth, block);
  const float scale = float(taps * taps);
  for (uint32_t i = 0; i < points.size(); ++i) {
    if (block.height[i] == kEnded) {
      result[i] = float(block.value[i]);
    } else if (block.height[i] == 0) {
      result[i] = filtered_alone(
          dag, {int32_t(block.voxel[0][i]), int32_t(block.voxel[1][i]), int32_t(block.voxel[2][i])}, taps);
    } else {
      result[i] = -1;
      if (tasks.count + kMostLeaves > tasks.x.size()) finish_tasks(dag, taps / 2, tasks, lit);
      add_leaves(block, i, int32_t(taps / 2), tasks);
    }
  }
  finish_tasks(dag, taps / 2, tasks, lit);
  for (uint32_t i = 0; i < points.size(); ++i)
    if (result[i] < 0) result[i] = float(lit[i]) / scale;
}

}  // namespace

void look_up(const DagView& dag, const LightGrid& light, std::span<const SurfacePoint> points, uint32_t taps,
             std::span<float> result) {
  const ReceiverMap map = receiver_map(light, taps);
  const size_t blocks = (points.size() + kBlockPoints - 1) / kBlockPoints;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, blocks, 8), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const size_t first = i * kBlockPoints, count = std::min(kBlockPoints, points.size() - first);
      look_up_block(dag, map, light.depth(), points.subspan(first, count), taps, result.subspan(first, count));
    }
  });
}

}  // namespace shadewright::voxel
#endif
