#include "node_pool.h"

#include <fmt/format.h>

#include <algorithm>

#include "shadewright/error.h"

namespace shadewright::voxel {

namespace {

uint64_t mix(uint64_t value) {
  value ^= value >> 32;
  value *= 0xd6e8feb86659fd93ull;
  value ^= value >> 32;
  value *= 0xd6e8feb86659fd93ull;
  return value ^ (value >> 32);
}

uint64_t hash_words(const uint32_t* words, uint32_t count) {
  uint64_t hash = 0x9e3779b97f4a7c15ull;
  for (uint32_t i = 0; i < count; ++i) hash = (hash ^ words[i]) * 0xff51afd7ed558ccdull, hash ^= hash >> 29;
  return mix(hash);
}

/// Reserves as vectors do, but tells the budget before the memory is taken.
template <typename T>
void reserve_for(std::vector<T>& items, size_t more, MemoryBudget& budget) {
  if (items.size() + more <= items.capacity()) return;
  const size_t capacity = std::max<size_t>(items.capacity() * 3 / 2 + more, 256);
  budget.add(capacity * sizeof(T));
  const size_t before = items.capacity();
  items.reserve(capacity);
  budget.remove(before * sizeof(T));
}

constexpr size_t kFirstTable = 256;

}  // namespace

void MemoryBudget::add(uint64_t bytes) {
  const uint64_t now = used_ += bytes;
  if (now > limit_)
    throw FailureError("bake", fmt::format("the memory bound of {:.2f} GB is not enough", double(limit_) * 1e-9),
                       "raise --memory or lower the resolution");
  uint64_t before = peak_.load();
  while (before < now && !peak_.compare_exchange_weak(before, now)) {
  }
}

NodePool::NodePool(MemoryBudget& budget) : budget_(&budget), shards_(std::make_unique<Shard[]>(kShards)) {}

void NodePool::grow(Shard& shard) {
  const size_t size = std::max(kFirstTable, shard.table.size() * 2);
  budget_->add(size * sizeof(uint32_t));
  std::vector<uint32_t> table(size, 0);
  for (const uint32_t entry : shard.table) {
    if (entry == 0) continue;
    const uint32_t* words = &shard.words[entry - 1];
    size_t slot = hash_words(words, node_words(words[0])) / kShards & (size - 1);
    while (table[slot] != 0) slot = (slot + 1) & (size - 1);
    table[slot] = entry;
  }
  budget_->remove(shard.table.size() * sizeof(uint32_t));
  shard.table = std::move(table);
}

uint32_t NodePool::insert(std::span<const uint32_t> words) {
  const uint64_t hash = hash_words(words.data(), uint32_t(words.size()));
  const uint32_t number = uint32_t(hash % kShards);
  Shard& shard = shards_[number];
  const tbb::spin_mutex::scoped_lock lock(shard.mutex);
  if (size_t(shard.count) * 2 >= shard.table.size()) grow(shard);
  const size_t mask = shard.table.size() - 1;
  size_t slot = hash / kShards & mask;
  for (; shard.table[slot] != 0; slot = (slot + 1) & mask) {
    const uint32_t offset = shard.table[slot] - 1;
    // The header says how long a node is, so that equal words cannot be a longer node's beginning.
    if (std::equal(words.begin(), words.end(), shard.words.begin() + offset)) return offset * kShards + number;
  }
  if (shard.words.size() + words.size() >= (uint64_t(1) << 32) / kShards - 1)
    throw FailureError("bake", "a level has more nodes than 32-bit pointers reach", "lower the resolution");
  reserve_for(shard.words, words.size() + kNodePadding, *budget_);
  const uint32_t offset = uint32_t(shard.words.size());
  shard.words.insert(shard.words.end(), words.begin(), words.end());
  shard.table[slot] = offset + 1;
  ++shard.count;
  return offset * kShards + number;
}

uint64_t NodePool::count() const {
  uint64_t sum = 0;
  for (uint32_t i = 0; i < kShards; ++i) sum += shards_[i].count;
  return sum;
}

std::vector<uint64_t> NodePool::slot_starts() const {
  std::vector<uint64_t> starts{0};
  for (uint32_t i = 0; i < kShards; ++i) starts.push_back(starts.back() + shards_[i].words.size());
  return starts;
}

LeafPool::LeafPool(MemoryBudget& budget) : budget_(&budget), shards_(std::make_unique<Shard[]>(kShards)) {}

void LeafPool::grow(Shard& shard) {
  const size_t size = std::max(kFirstTable, shard.table.size() * 2);
  budget_->add(size * sizeof(uint32_t));
  std::vector<uint32_t> table(size, 0);
  for (const uint32_t entry : shard.table) {
    if (entry == 0) continue;
    size_t slot = mix(shard.masks[entry - 1]) / kShards & (size - 1);
    while (table[slot] != 0) slot = (slot + 1) & (size - 1);
    table[slot] = entry;
  }
  budget_->remove(shard.table.size() * sizeof(uint32_t));
  shard.table = std::move(table);
}

uint32_t LeafPool::insert(uint64_t leaf) {
  const uint64_t hash = mix(leaf);
  const uint32_t number = uint32_t(hash % kShards);
  Shard& shard = shards_[number];
  const tbb::spin_mutex::scoped_lock lock(shard.mutex);
  if (shard.masks.size() * 2 >= shard.table.size()) grow(shard);
  const size_t mask = shard.table.size() - 1;
  size_t slot = hash / kShards & mask;
  for (; shard.table[slot] != 0; slot = (slot + 1) & mask)
    if (shard.masks[shard.table[slot] - 1] == leaf) return (shard.table[slot] - 1) * kShards + number;
  if (shard.masks.size() + 1 >= (uint64_t(1) << 32) / kShards - 1)
    throw FailureError("bake", "there are more leaves than 32-bit pointers reach", "lower the resolution");
  reserve_for(shard.masks, 1, *budget_);
  shard.masks.push_back(leaf);
  shard.table[slot] = uint32_t(shard.masks.size());
  return (shard.table[slot] - 1) * kShards + number;
}

uint64_t LeafPool::count() const {
  return slot_starts().back();
}

std::vector<uint64_t> LeafPool::slot_starts() const {
  std::vector<uint64_t> starts{0};
  for (uint32_t i = 0; i < kShards; ++i) starts.push_back(starts.back() + shards_[i].masks.size());
  return starts;
}

}  // namespace shadewright::voxel
