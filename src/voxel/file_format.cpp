#include "file_format.h"

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "shadewright/error.h"
#include "validate.h"

namespace shadewright::voxel {

namespace {

class Parser {
 public:
  Parser(std::span<const std::byte> bytes, const std::string& name, const ParseOptions& options,
         std::shared_ptr<const void> owner)
      : bytes_(bytes), name_(name), options_(options), storage_(std::make_shared<Storage>()) {
    storage_->file = std::move(owner);
  }

  VoxelShadow run() {
    read_header();
    ShadowProperties properties = read_properties();
    std::vector<DagView> dags;
    std::vector<std::vector<uint64_t>> level_starts;
    for (uint32_t i = 0; i < header_.dag_count; ++i) {
      const FileDag& dag = header_.dags[i];
      if (dag.log2_size + i != header_.log2_size || dag.levels >= kMaxLevels) damaged();
      dags.push_back({dag.log2_size, dag.log2_grid, section<uint32_t>(dag.grid), section<uint32_t>(dag.nodes),
                      section<uint64_t>(dag.leaves)});
      level_starts.emplace_back(dag.level_starts.begin(), dag.level_starts.begin() + dag.levels + 1);
      if (!is_sound(dags.back(), level_starts.back())) damaged();
    }
    return VoxelShadow(properties, std::move(dags), std::move(level_starts), storage_);
  }

 private:
  /// The file, and sections that had to be decompressed.
  struct Storage {
    std::shared_ptr<const void> file;
    std::vector<std::vector<uint64_t>> sections;
  };

  [[noreturn]] void refuse(const std::string& problem) const { throw InputError(name_, problem, "bake it again"); }
  [[noreturn]] void damaged() const { refuse("is damaged: its contents do not fit together"); }

  void read_header() {
    if (bytes_.size() < kMagic.size() || std::memcmp(bytes_.data(), kMagic.data(), kMagic.size()) != 0)
      throw InputError(name_, "is not a .cpvs file", "give a file that `shadewright bake` wrote");
    header_ = {};
    std::memcpy(&header_, bytes_.data(), std::min(bytes_.size(), sizeof(header_)));
    if (bytes_.size() < 16) refuse("is truncated");
    if (header_.byte_order != kByteOrder) refuse("was written on a machine of another byte order");
    if (header_.version != kFileVersion)
      refuse(fmt::format("is of version {}, this program reads version {}", header_.version, kFileVersion));
    if (bytes_.size() < sizeof(header_)) refuse("is truncated");
    if (header_.header_bytes != sizeof(header_)) damaged();
    if (options_.check_sums && header_checksum(header_) != header_.checksum)
      refuse("is damaged: its header's checksum is wrong");
    if (bytes_.size() < header_.file_bytes) refuse("is truncated");
    if (bytes_.size() > header_.file_bytes) refuse("is damaged: it is longer than it should be");
  }

  ShadowProperties read_properties() const {
    const FileHeader& h = header_;
    const auto finite = [](const auto& values) {
      return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
    };
    if (h.light_kind > 1 || h.log2_size < 6 || h.log2_size > 20 || h.log2_depth < 6 || h.log2_depth > h.log2_size ||
        h.max_filter % 2 == 0 || h.max_filter > 17 || h.filter_margin < 0 || h.dag_count < 1 ||
        h.dag_count > kMaxDags || !finite(h.voxel_from_world) || !finite(h.light_from_world) ||
        !finite(std::array{h.texel_size[0], h.texel_size[1], h.voxel_depth, h.near, h.far}))
      damaged();
    ShadowProperties properties;
    LightGrid& light = properties.light;
    light.kind = h.light_kind == 0 ? LightKind::directional : LightKind::spot;
    light.log2_size = h.log2_size;
    light.log2_depth = h.log2_depth;
    for (int i = 0; i < 16; ++i) light.voxel_from_world[i / 4][i % 4] = h.voxel_from_world[size_t(i)];
    for (int i = 0; i < 9; ++i) light.light_from_world[i / 3][i % 3] = h.light_from_world[size_t(i)];
    light.texel_size = {h.texel_size[0], h.texel_size[1]};
    light.voxel_depth = h.voxel_depth;
    light.near = h.near;
    light.far = h.far;
    properties.max_filter = h.max_filter;
    properties.filter_margin = h.filter_margin;
    properties.static_receivers = h.static_receivers != 0;
    properties.all_closed = h.all_closed != 0;
    return properties;
  }

  template <typename T>
  std::span<const T> section(const FileSection& section) {
    if (section.offset % kSectionAlignment != 0 || section.offset > bytes_.size() ||
        section.stored_bytes > bytes_.size() - section.offset || section.raw_bytes % sizeof(T) != 0)
      damaged();
    const std::span<const std::byte> stored = bytes_.subspan(section.offset, section.stored_bytes);
    if (options_.check_sums && XXH3_64bits(stored.data(), stored.size()) != section.checksum)
      refuse("is damaged: a section's checksum is wrong");
    if (section.compressed == 0) {
      if (section.raw_bytes != section.stored_bytes) damaged();
      return {reinterpret_cast<const T*>(stored.data()), stored.size() / sizeof(T)};
    }
    // The frame must announce the size, so that a small file cannot claim more memory than it fills.
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != section.raw_bytes) damaged();
    if (section.raw_bytes > options_.memory_limit - held_)
      throw InputError(name_,
                       fmt::format("would take more than {:.1f} GB of memory", double(options_.memory_limit) * 1e-9),
                       "bake a lower resolution or without compression");
    held_ += section.raw_bytes;
    std::vector<uint64_t>& raw = storage_->sections.emplace_back((section.raw_bytes + 7) / 8);
    if (ZSTD_decompress(raw.data(), section.raw_bytes, stored.data(), stored.size()) != section.raw_bytes)
      refuse("is damaged: a section cannot be decompressed");
    return {reinterpret_cast<const T*>(raw.data()), section.raw_bytes / sizeof(T)};
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  ParseOptions options_;
  std::shared_ptr<Storage> storage_;
  uint64_t held_ = 0;
  FileHeader header_;
};

}  // namespace

uint64_t header_checksum(FileHeader header) {
  header.checksum = 0;
  return XXH3_64bits(&header, sizeof(header));
}

VoxelShadow parse(std::span<const std::byte> bytes, const std::string& name, const ParseOptions& options,
                  std::shared_ptr<const void> owner) {
  return Parser(bytes, name, options, std::move(owner)).run();
}

}  // namespace shadewright::voxel
