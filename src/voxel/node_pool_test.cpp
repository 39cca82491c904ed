// The pools are what a bake's threads share. Plain threads here, not TBB's: ThreadSanitizer sees all of their
// synchronization.
#include "node_pool.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <thread>

#include "shadewright/error.h"

namespace shadewright::voxel {
namespace {

constexpr uint32_t kThreads = 4, kNodes = 20011;  // a prime, so that every stride visits all

/// Node number i: as many pointers as its header says.
std::vector<uint32_t> node(uint32_t i) {
  std::vector<uint32_t> words{0};
  for (uint32_t child = 0; child <= i % 8; ++child) {
    words[0] |= kOwnPointer << (2 * child);
    words.push_back(i * 2654435761u + child);
  }
  return words;
}

template <typename Work>
void on_threads(Work work) {
  std::vector<std::thread> threads;
  for (uint32_t thread = 0; thread < kThreads; ++thread) threads.emplace_back([&work, thread] { work(thread); });
  for (std::thread& thread : threads) thread.join();
}

TEST(VoxelPools, EqualNodesExistOnce) {
  MemoryBudget budget(uint64_t(1) << 30);
  NodePool pool(budget);
  std::vector<std::vector<uint32_t>> ids(kThreads, std::vector<uint32_t>(kNodes));
  on_threads([&](uint32_t thread) {
    // Each thread in an order of its own.
    for (uint32_t i = 0; i < kNodes; ++i) {
      const uint32_t which = uint32_t((uint64_t(i) * (2 * thread + 7919)) % kNodes);
      ids[thread][which] = pool.insert(node(which));
    }
  });
  EXPECT_EQ(pool.count(), kNodes);
  for (uint32_t thread = 1; thread < kThreads; ++thread) EXPECT_EQ(ids[thread], ids[0]);
  EXPECT_EQ(std::set<uint32_t>(ids[0].begin(), ids[0].end()).size(), kNodes);
  for (uint32_t i = 0; i < kNodes; ++i) {
    const std::vector<uint32_t> expected = node(i);
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), pool.words(ids[0][i])));
  }
}

TEST(VoxelPools, EqualLeavesExistOnce) {
  MemoryBudget budget(uint64_t(1) << 30);
  LeafPool pool(budget);
  std::vector<std::vector<uint32_t>> ids(kThreads, std::vector<uint32_t>(kNodes));
  on_threads([&](uint32_t thread) {
    for (uint32_t i = 0; i < kNodes; ++i) {
      const uint32_t which = uint32_t((uint64_t(i) * (2 * thread + 7919)) % kNodes);
      ids[thread][which] = pool.insert((which + 1) * 0x9e3779b97f4a7c15ull);
    }
  });
  EXPECT_EQ(pool.count(), kNodes);
  for (uint32_t thread = 1; thread < kThreads; ++thread) EXPECT_EQ(ids[thread], ids[0]);
  for (uint32_t i = 0; i < kNodes; ++i) ASSERT_EQ(pool.mask(ids[0][i]), (i + 1) * 0x9e3779b97f4a7c15ull);
}

TEST(VoxelPools, KeepTheBound) {
  MemoryBudget budget(1 << 20);
  NodePool pool(budget);
  EXPECT_THROW(
      {
        for (uint32_t i = 0; i < 1000000; ++i) pool.insert(node(i));
      },
      FailureError);
  EXPECT_LE(budget.peak(), uint64_t(1) << 20);
}

}  // namespace
}  // namespace shadewright::voxel
