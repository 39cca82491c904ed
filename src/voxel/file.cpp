#include "shadewright/voxel/file.h"

#include <xxhash.h>
#include <zstd.h>

#include <bit>
#include <cstring>
#include <fstream>

#include "file_format.h"
#include "mapped_file.h"
#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright::voxel {

namespace {

constexpr int kZstdLevel = 9;

class Writer {
 public:
  Writer(const std::filesystem::path& file, const std::filesystem::path& target, bool compress)
      : stream_(file, std::ios::binary | std::ios::trunc), target_(target), compress_(compress) {
    check();
    position_ = sizeof(FileHeader);
    const std::vector<char> room(sizeof(FileHeader), 0);
    stream_.write(room.data(), std::streamsize(room.size()));
  }

  template <typename T>
  FileSection section(std::span<const T> items) {
    std::span<const char> bytes(reinterpret_cast<const char*>(items.data()), items.size_bytes());
    FileSection section{0, bytes.size(), bytes.size(), 0, 0};
    std::vector<char> packed;
    if (compress_ && !bytes.empty()) {
      packed.resize(ZSTD_compressBound(bytes.size()));
      const size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
      if (!ZSTD_isError(size) && size < bytes.size()) {
        bytes = {packed.data(), size};
        section.stored_bytes = size;
        section.compressed = 1;
      }
    }
    constexpr std::array<char, kSectionAlignment> padding{};
    const size_t gap = (kSectionAlignment - position_ % kSectionAlignment) % kSectionAlignment;
    stream_.write(padding.data(), std::streamsize(gap));
    section.offset = position_ + gap;
    stream_.write(bytes.data(), std::streamsize(bytes.size()));
    section.checksum = XXH3_64bits(bytes.data(), bytes.size());
    position_ = section.offset + bytes.size();
    check();
    return section;
  }

  void finish(FileHeader& header) {
    header.file_bytes = position_;
    header.checksum = header_checksum(header);
    stream_.seekp(0);
    stream_.write(reinterpret_cast<const char*>(&header), sizeof(header));
    stream_.close();
    check();
  }

 private:
  void check() const {
    if (!stream_) throw FailureError(target_.string(), "cannot be written", "check the folder and the free space");
  }

  std::ofstream stream_;
  const std::filesystem::path& target_;
  bool compress_;
  uint64_t position_ = 0;
};

FileHeader describe(const VoxelShadow& shadow) {
  FileHeader header;
  std::memset(&header, 0, sizeof(header));
  const LightGrid& light = shadow.light();
  header.magic = kMagic;
  header.version = kFileVersion;
  header.byte_order = kByteOrder;
  header.header_bytes = sizeof(header);
  header.light_kind = light.kind == LightKind::directional ? 0 : 1;
  header.log2_size = light.log2_size;
  header.log2_depth = light.log2_depth;
  header.max_filter = shadow.properties().max_filter;
  header.filter_margin = shadow.properties().filter_margin;
  header.static_receivers = shadow.properties().static_receivers;
  header.all_closed = shadow.properties().all_closed;
  header.dag_count = uint32_t(shadow.dags().size());
  for (int i = 0; i < 16; ++i) header.voxel_from_world[size_t(i)] = light.voxel_from_world[i / 4][i % 4];
  for (int i = 0; i < 9; ++i) header.light_from_world[size_t(i)] = light.light_from_world[i / 3][i % 3];
  header.texel_size = {light.texel_size.x, light.texel_size.y};
  header.voxel_depth = light.voxel_depth;
  header.near = light.near;
  header.far = light.far;
  return header;
}

}  // namespace

void save(const VoxelShadow& shadow, const std::filesystem::path& file, const SaveOptions& options,
          const Progress& progress) {
  static_assert(std::endian::native == std::endian::little, "the file is little-endian");
  progress("write", 0.0);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    Writer writer(temporary, file, options.compress);
    FileHeader header = describe(shadow);
    for (size_t i = 0; i < shadow.dags().size(); ++i) {
      const DagView& dag = shadow.dags()[i];
      const std::span<const uint64_t> starts = shadow.level_starts(i);
      FileDag& entry = header.dags[i];
      entry.log2_size = dag.log2_size;
      entry.log2_grid = dag.log2_grid;
      entry.levels = uint32_t(starts.size() - 1);
      std::copy(starts.begin(), starts.end(), entry.level_starts.begin());
      entry.grid = writer.section(dag.grid);
      entry.nodes = writer.section(dag.nodes);
      entry.leaves = writer.section(dag.leaves);
      progress("write", double(i + 1) / double(shadow.dags().size()));
    }
    writer.finish(header);
  });
}

VoxelShadow open(const std::filesystem::path& file, uint64_t memory_limit) {
  const auto mapped = std::make_shared<const MappedFile>(file);
  return parse(mapped->bytes(), file.string(), {memory_limit, true}, mapped);
}

}  // namespace shadewright::voxel
