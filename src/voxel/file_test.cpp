// Saving and opening, and what becomes of damaged files: always one sentence, never a crash.
#include "shadewright/voxel/file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "file_format.h"
#include "shadewright/error.h"
#include "shadewright/voxel/bake.h"
#include "test_scenes.h"

namespace shadewright::voxel {
namespace {

class File : public testing::Test {
 protected:
  File() {
    folder_ =
        std::filesystem::temp_directory_path() / ("shadewright_file_test_" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(folder_);
    std::mt19937 random(11);
    BakeOptions options;
    options.resolution = 256;
    options.pyramid = true;
    shadow_ = bake(random_bodies(random, 12), Light{}, options).shadow;
  }
  ~File() override { std::filesystem::remove_all(folder_); }

  static std::vector<char> read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void write(const std::filesystem::path& file, std::span<const char> bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  }

  std::filesystem::path folder_;
  VoxelShadow shadow_;
};

void expect_same(const VoxelShadow& a, const VoxelShadow& b) {
  ASSERT_EQ(a.dags().size(), b.dags().size());
  for (size_t i = 0; i < a.dags().size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(a.dags()[i].grid, b.dags()[i].grid));
    EXPECT_TRUE(std::ranges::equal(a.dags()[i].nodes, b.dags()[i].nodes));
    EXPECT_TRUE(std::ranges::equal(a.dags()[i].leaves, b.dags()[i].leaves));
    EXPECT_TRUE(std::ranges::equal(a.level_starts(i), b.level_starts(i)));
  }
  EXPECT_EQ(a.light().voxel_from_world, b.light().voxel_from_world);
  EXPECT_EQ(a.light().light_from_world, b.light().light_from_world);
  EXPECT_EQ(a.properties().max_filter, b.properties().max_filter);
  EXPECT_EQ(a.properties().filter_margin, b.properties().filter_margin);
}

TEST_F(File, ComesBackAsItWas) {
  save(shadow_, folder_ / "plain.cpvs");
  save(shadow_, folder_ / "packed.cpvs", {.compress = true});
  EXPECT_LT(std::filesystem::file_size(folder_ / "packed.cpvs"), std::filesystem::file_size(folder_ / "plain.cpvs"));
  const VoxelShadow plain = open(folder_ / "plain.cpvs"), packed = open(folder_ / "packed.cpvs");
  expect_same(shadow_, plain);
  expect_same(shadow_, packed);
  for (int i = 0; i < 1000; ++i) {
    const glm::ivec3 at(i % 256, (i * 7) % 256, (i * 13) % 256);
    EXPECT_EQ(plain.filtered(at, 9), shadow_.filtered(at, 9));
  }
}

TEST_F(File, NamesWhatIsWrong) {
  save(shadow_, folder_ / "a.cpvs");
  const std::vector<char> bytes = read(folder_ / "a.cpvs");
  const auto sentence = [&](std::vector<char> damaged) -> std::string {
    write(folder_ / "b.cpvs", damaged);
    try {
      open(folder_ / "b.cpvs");
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(sentence({}).find("cpvs"), std::string::npos);
  EXPECT_NE(sentence({'G', 'I', 'F', '8'}).find("not a .cpvs file"), std::string::npos);
  EXPECT_NE(sentence({bytes.begin(), bytes.begin() + 100}).find("truncated"), std::string::npos);
  EXPECT_NE(sentence({bytes.begin(), bytes.end() - 1}).find("truncated"), std::string::npos);
  std::vector<char> other = bytes;
  other[4] = 9;
  EXPECT_NE(sentence(other).find("version 9"), std::string::npos);
  other = bytes;
  std::swap(other[8], other[11]);
  EXPECT_NE(sentence(other).find("byte order"), std::string::npos);
  other = bytes;
  other[other.size() - 3] = char(other[other.size() - 3] ^ 1);
  EXPECT_NE(sentence(other).find("checksum"), std::string::npos);
  EXPECT_THROW(open(folder_ / "missing.cpvs"), InputError);
  EXPECT_THROW(open(folder_), InputError);
  save(shadow_, folder_ / "packed.cpvs", {.compress = true});
  EXPECT_THROW(open(folder_ / "packed.cpvs", 1000), InputError);
}

TEST_F(File, LeavesNothingBehind) {
  struct Cancelled {};
  const auto cancel = [](std::string_view, double fraction) {
    if (fraction > 0) throw Cancelled{};
  };
  EXPECT_THROW(save(shadow_, folder_ / "a.cpvs", {}, cancel), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_THROW(save(shadow_, folder_ / "no" / "such" / "folder.cpvs"), FailureError);
}

/// Bytes are changed behind the checksums' back: what still opens must answer every look-up inside its memory.
TEST_F(File, SurvivesMutations) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const bool compress : {false, true}) {
    save(shadow_, folder_ / "a.cpvs", {.compress = compress});
    const std::vector<char> bytes = read(folder_ / "a.cpvs");
    const auto aligned = std::make_unique<uint64_t[]>(bytes.size() / 8 + 1);
    char* data = reinterpret_cast<char*>(aligned.get());
    for (int round = 0; round < 300; ++round) {
      std::memcpy(data, bytes.data(), bytes.size());
      size_t size = bytes.size();
      for (uint32_t change = uint32_t(random()) % 4 + 1; change > 0; --change) {
        const size_t limit = random() % 2 ? std::min(size, sizeof(FileHeader)) : size;
        const size_t at = random() % limit;
        switch (random() % 4) {
          case 0:
            data[at] = char(random());
            break;
          case 1:
            data[at] = char(data[at] ^ (1 << random() % 8));
            break;
          case 2:
            std::memset(data + at, random() % 2 ? 0xff : 0, std::min<size_t>(random() % 64, size - at));
            break;
          default:
            size = random() % 16 ? size : at + 1;
        }
      }
      try {
        const VoxelShadow shadow =
            parse({reinterpret_cast<const std::byte*>(data), size}, "mutated", {uint64_t(1) << 28, false}, nullptr);
        for (int i = 0; i < 200; ++i) {
          const glm::ivec3 at(int(random() % 256), int(random() % 256), int(random() % 256));
          (void)shadow.filtered(at, shadow.properties().max_filter);
        }
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace shadewright::voxel
