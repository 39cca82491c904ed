// The voxel DAG as it lies in memory, in the file and on the GPU (CPVS, section 4; layout of section 5 for filters).
//
// A grid replaces the top levels: one word a cell, 0 = shadowed, 1 = visible, else the word offset of a node in
// `nodes`. A node of height k (its side is 2^k voxels) is one word: 8 child codes of 2 bits in the low half, and in the
// high half its occupancy (the share of shadowed voxels, times 65535), followed by one 32-bit pointer for every child
// with code 2.
//   code 0: all shadowed   1: all visible   2: intersected, has a pointer   3: intersected, shares an earlier pointer
// Heights above 3 split into octants, child = x | y << 1 | z << 2; code 3 there means "as the child with z = 0".
// Height 3 (8 x 8 x 8 voxels) splits into 8 slabs along z; code 3 there means "as the last child with code 2 before
// it". Its pointers are indices of `leaves`: 8 x 8 x 1 voxels, bit (y & 7) * 8 + (x & 7), 1 = visible.
//
// Differs from the paper: code 3. In light space most nodes are alike along z (figure 2), so that the paper's layout
// repeats the same pointer; sharing it needs no space, as the fourth code was free.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace shadewright::voxel {

/// Grid cells and child codes of volumes without an inside boundary.
inline constexpr uint32_t kShadowed = 0, kVisible = 1;
/// Child codes of intersected children.
inline constexpr uint32_t kOwnPointer = 2, kSharedPointer = 3;
/// `nodes` starts with this many unused words, so that no node is at 0 or 1, and ends with as many zeros as a node can
/// read.
inline constexpr uint32_t kNodePadding = 8;
/// Side of a leaf, and height (log2 of the side) of the lowest nodes.
inline constexpr uint32_t kLeafSide = 8, kSlabHeight = 3;

/// One DAG: views of memory that someone else owns.
struct DagView {
  uint32_t log2_size = 0;  ///< n: the volume has 2^n voxels per axis
  uint32_t log2_grid =
      0;  ///< the grid has 2^this cells per axis, cell (x, y, z) at x + (y << log2_grid) + (z << 2 log2_grid)
  std::span<const uint32_t> grid;
  std::span<const uint32_t> nodes;
  std::span<const uint64_t> leaves;
};

/// The code of `child` in a node's first word.
inline uint32_t child_code(uint32_t header, uint32_t child) {
  return (header >> (2 * child)) & 3;
}

/// Bit 2c + 1 is set for each child c that owns a pointer.
inline uint32_t own_pointers(uint32_t header) {
  return header & 0xaaaau & ~(header << 1);
}

/// Index among the node's pointers of an intersected child; `child` is in 0..7.
inline uint32_t pointer_index(uint32_t header, uint32_t child, bool octants) {
  const uint32_t owner = octants && child_code(header, child) == kSharedPointer ? child & 3 : child;
  return uint32_t(std::popcount(own_pointers(header) & ((4u << (2 * owner)) - 1))) - 1;
}

/// Words of a node with this first word.
inline uint32_t node_words(uint32_t header) {
  return 1 + uint32_t(std::popcount(own_pointers(header)));
}

}  // namespace shadewright::voxel
