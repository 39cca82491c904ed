// A file's bytes, mapped where the system can, read where it cannot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace shadewright::voxel {

class MappedFile {
 public:
  /// InputError if the file cannot be read.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
  std::vector<std::byte> read_;  ///< where mapping is not possible
};

}  // namespace shadewright::voxel
