// The file of a baked shadow (.cpvs): written once, mapped into memory to be used.
#pragma once

#include <cstdint>
#include <filesystem>

#include "shadewright/progress.h"
#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

struct SaveOptions {
  bool compress = false;  ///< zstd each section: smaller on disk, but it is read into memory instead of mapped
};

/// Writes `shadow` beside `file` and renames: on failure, or if `progress` throws, nothing is left. The bytes depend on
/// the shadow alone. FailureError when the disk fails.
void save(const VoxelShadow& shadow, const std::filesystem::path& file, const SaveOptions& options = {},
          const Progress& progress = no_progress);

/// Opens what `save` wrote; sections that are not compressed stay mapped. Checksums and every pointer are checked, so
/// that no look-up can leave the data. InputError, one sentence, for files that are missing, truncated, altered, of
/// another version or byte order, or that would take more than `memory_limit` bytes.
VoxelShadow open(const std::filesystem::path& file, uint64_t memory_limit = uint64_t(16) << 30);

}  // namespace shadewright::voxel
