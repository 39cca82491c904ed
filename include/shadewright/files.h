// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace shadewright {

/// Lets `write` fill a temporary file beside `file`, then renames it. If `write` throws, or the disk fails, nothing is
/// left and what stood there before stays. FailureError names the file.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes `bytes` so.
void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
/// Writes `text` so.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Lets `write` fill a temporary folder, then moves what it wrote into `folder`, which is made if need be: entries of
/// the same name are replaced, others stay. If `write` throws nothing is left, and what stood there before stays.
/// FailureError names the folder; where none can be made it comes before `write`.
void write_folder(const std::filesystem::path& folder,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes `bytes` to standard output and flushes it. FailureError if they, or what was printed before, did not get out.
void write_standard_output(std::span<const std::byte> bytes);
/// Writes `text` so.
void write_standard_output(std::string_view text);

/// A file name for any text: letters, digits and dots stay, the rest becomes dashes.
std::string file_stem(std::string_view text);

}  // namespace shadewright
