// The bytes of a .cpvs file: a header of fixed size, then sections on 64-byte borders. Little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

inline constexpr uint32_t kFileVersion = 1, kByteOrder = 0x01020304;
inline constexpr std::array<char, 4> kMagic{'C', 'P', 'V', 'S'};
inline constexpr size_t kSectionAlignment = 64, kMaxDags = 16, kMaxLevels = 20;

struct FileSection {
  uint64_t offset, stored_bytes, raw_bytes;
  uint64_t checksum;    ///< XXH3 (64 bits) of the stored bytes
  uint64_t compressed;  ///< 1 = one zstd frame
};

struct FileDag {
  uint32_t log2_size, log2_grid, levels, unused;
  std::array<uint64_t, kMaxLevels> level_starts;  ///< levels + 1 of them
  FileSection grid, nodes, leaves;
};

struct FileHeader {
  std::array<char, 4> magic;
  uint32_t version, byte_order, header_bytes;
  uint64_t checksum;  ///< XXH3 of the header with this field zero
  uint64_t file_bytes;
  uint32_t light_kind;  ///< 0 directional, 1 spot
  uint32_t log2_size, log2_depth, max_filter;
  int32_t filter_margin;
  uint32_t static_receivers, all_closed, dag_count;
  std::array<double, 16> voxel_from_world;  ///< column by column
  std::array<double, 9> light_from_world;
  std::array<double, 2> texel_size;
  double voxel_depth, near, far;
  std::array<FileDag, kMaxDags> dags;
};
static_assert(sizeof(FileHeader) % 8 == 0 && sizeof(FileSection) == 40);

/// XXH3 of the header, its checksum field taken as zero.
uint64_t header_checksum(FileHeader header);

struct ParseOptions {
  uint64_t memory_limit = uint64_t(16) << 30;
  bool check_sums = true;  ///< false only where random bytes should get past the checksums: fuzzing
};

/// A shadow that refers to `bytes` (8-byte aligned) where sections are not compressed; `owner` keeps them alive. `name`
/// stands in the InputError for anything that is not a sound file.
VoxelShadow parse(std::span<const std::byte> bytes, const std::string& name, const ParseOptions& options,
                  std::shared_ptr<const void> owner);

}  // namespace shadewright::voxel
