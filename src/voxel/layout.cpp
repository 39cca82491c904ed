#include "layout.h"

#include <algorithm>

#include "shadewright/error.h"

namespace shadewright::voxel {

namespace {

constexpr uint32_t kUnvisited = ~0u;

/// Canonical numbers of one height's nodes, given out as they are first met.
struct Numbering {
  std::vector<uint64_t> starts;
  std::vector<uint32_t> number;  ///< by slot
  std::vector<uint32_t> order;   ///< pool ids by number

  explicit Numbering(std::vector<uint64_t> slot_starts)
      : starts(std::move(slot_starts)), number(starts.back(), kUnvisited) {}
};

class Walk {
 public:
  Walk(const DagBuilder& builder, uint32_t log2_grid, Dag& dag)
      : builder_(builder), dag_(dag), cell_height_(builder.log2_size() - log2_grid), log2_grid_(log2_grid) {}

  void run(Value root) {
    dag_.grid.assign(size_t(1) << (3 * log2_grid_), kShadowed);
    dag_.nodes.assign(kNodePadding, 0);
    dag_.level_starts = {kNodePadding};
    next_ = kNodePadding;
    Numbering level = numbering(cell_height_);
    fill_grid(builder_.log2_size(), root, 0, 0, 0, level);
    for (uint32_t height = cell_height_; height > kSlabHeight; --height) level = emit(height, level);
    emit_slabs(level);
    dag_.nodes.resize(dag_.nodes.size() + kNodePadding, 0);
  }

 private:
  Numbering numbering(uint32_t height) const { return Numbering(builder_.pool(height).slot_starts()); }

  /// The word offset of a node one level down, which is laid out from `next_` on.
  uint32_t offset_of(uint32_t height, uint32_t id, Numbering& level) {
    uint32_t& number = level.number[NodePool::slot(level.starts, id)];
    if (number == kUnvisited) {
      if (next_ > 0xffffffffull - 2 * kNodePadding)
        throw FailureError("bake", "the nodes need more than 32-bit pointers reach", "lower the resolution");
      number = uint32_t(next_);
      next_ += node_words(*builder_.pool(height).words(id));
      level.order.push_back(id);
    }
    return number;
  }

  void fill_grid(uint32_t height, Value value, uint32_t x, uint32_t y, uint32_t z, Numbering& level) {
    if (height == cell_height_ || !is_node(value)) {
      const uint32_t cells = 1u << (height - cell_height_);
      const uint32_t word = is_node(value)          ? offset_of(height, value - kFirstNode, level)
                            : value == kAllShadowed ? kShadowed
                                                    : kVisible;
      for (uint32_t k = z; k < z + cells; ++k)
        for (uint32_t j = y; j < y + cells; ++j)
          std::fill_n(&dag_.grid[(size_t(k) << 2 * log2_grid_) + (size_t(j) << log2_grid_) + x], cells, word);
      return;
    }
    const uint32_t* words = builder_.pool(height).words(value - kFirstNode);
    const uint32_t half = 1u << (height - 1 - cell_height_);
    for (uint32_t child = 0; child < 8; ++child) {
      const uint32_t code = child_code(words[0], child);
      const Value content = code < kOwnPointer ? code : kFirstNode + words[1 + pointer_index(words[0], child, true)];
      fill_grid(height - 1, content, x + (child & 1) * half, y + (child >> 1 & 1) * half, z + (child >> 2) * half,
                level);
    }
  }

  /// Writes the nodes of `height` and numbers those below.
  Numbering emit(uint32_t height, const Numbering& level) {
    Numbering below = numbering(height - 1);
    dag_.level_starts.push_back(next_);
    dag_.nodes.reserve(next_);
    for (const uint32_t id : level.order) {
      const uint32_t* words = builder_.pool(height).words(id);
      dag_.nodes.push_back(words[0]);
      for (uint32_t i = 1; i < node_words(words[0]); ++i) dag_.nodes.push_back(offset_of(height - 1, words[i], below));
    }
    return below;
  }

  void emit_slabs(const Numbering& level) {
    dag_.level_starts.push_back(next_);
    dag_.nodes.reserve(next_ + kNodePadding);
    Numbering leaves(builder_.leaves().slot_starts());
    for (const uint32_t id : level.order) {
      const uint32_t* words = builder_.pool(kSlabHeight).words(id);
      dag_.nodes.push_back(words[0]);
      for (uint32_t i = 1; i < node_words(words[0]); ++i) {
        uint32_t& number = leaves.number[LeafPool::slot(leaves.starts, words[i])];
        if (number == kUnvisited) {
          number = uint32_t(dag_.leaves.size());
          dag_.leaves.push_back(builder_.leaves().mask(words[i]));
        }
        dag_.nodes.push_back(number);
      }
    }
  }

  const DagBuilder& builder_;
  Dag& dag_;
  uint32_t cell_height_, log2_grid_;
  uint64_t next_ = 0;  ///< word offset of the next node to be numbered
};

/// Occupancy of every node (VOAA, section 5): the share of shadowed voxels, from the leaves up. After merging, so that
/// it cannot keep equal nodes apart.
void fill_occupancy(Dag& dag) {
  const size_t levels = dag.level_starts.size() - 1;
  for (size_t level = levels; level-- > 0;) {
    const bool slabs = level + 1 == levels;
    for (uint64_t at = dag.level_starts[level]; at < dag.level_starts[level + 1];) {
      const uint32_t header = dag.nodes[at];
      uint32_t sum = 0;
      for (uint32_t child = 0; child < 8; ++child) {
        const uint32_t code = child_code(header, child);
        if (code < kOwnPointer) {
          sum += code == kShadowed ? 65535u : 0u;
          continue;
        }
        const uint32_t pointer = dag.nodes[at + 1 + pointer_index(header, child, !slabs)];
        sum += slabs ? (uint32_t(std::popcount(~dag.leaves[pointer])) * 65535u + 32) / 64 : dag.nodes[pointer] >> 16;
      }
      dag.nodes[at] |= (sum + 4) / 8 << 16;
      at += node_words(header);
    }
  }
}

}  // namespace

uint32_t grid_for(uint32_t log2_size) {
  return std::min(7u, log2_size - 5);
}

Dag lay_out(const DagBuilder& builder, Value root, uint32_t log2_grid) {
  Dag dag;
  dag.log2_size = builder.log2_size();
  dag.log2_grid = log2_grid;
  Walk(builder, log2_grid, dag).run(root);
  fill_occupancy(dag);
  return dag;
}

}  // namespace shadewright::voxel
