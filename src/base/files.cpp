#include "shadewright/files.h"

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "shadewright/error.h"

namespace shadewright {

namespace {

namespace fs = std::filesystem;

/// The nearest folder at or above `folder` that exists: what is written there can be moved to `folder`, on the same
/// disk.
fs::path nearest_existing(fs::path folder) {
  std::error_code ignored;
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// "NAME.part", or "NAME.part-2" and so on where that is somebody's: what stands beside is not ours to overwrite.
/// `take` says of a path whether it was free.
fs::path place_beside(const fs::path& name, const std::function<bool(const fs::path&)>& take) {
  for (int i = 1;; ++i) {
    fs::path place = name;
    place += i == 1 ? ".part" : ".part-" + std::to_string(i);
    if (take(place)) return place;
  }
}

/// Throws filesystem_error.
void move_entries(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
    const fs::path target = to / entry.path().filename();
    if (entry.is_directory() || fs::is_directory(target)) fs::remove_all(target);
    fs::rename(entry.path(), target);
  }
}

}  // namespace

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
  std::error_code error;
  const fs::path temporary = place_beside(file, [&](const fs::path& place) { return !fs::exists(place, error); });
  try {
    write(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
  std::filesystem::rename(temporary, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw FailureError(file.string(), "can't be written (" + error.message() + ")", "choose another place with -o");
}

void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream)
      throw FailureError(file.string(), "can't be written", "check that its folder exists and the disk has room");
  });
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  write_file(file, std::as_bytes(std::span(text)));
}

void write_folder(const fs::path& folder, const std::function<void(const fs::path&)>& write) {
  const auto refuse = [&](const std::error_code& error) {
    throw FailureError(folder.string(), "can't be made or written into (" + error.message() + ")",
                       "choose another folder");
  };
  fs::path place = fs::absolute(folder).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();  // it ended in a slash
  std::error_code error;
  const fs::path temporary = place_beside(nearest_existing(place) / place.filename(), [&](const fs::path& beside) {
    return !fs::exists(beside, error) && (fs::create_directory(beside, error) || error);
  });
  if (error) refuse(error);
  struct Removal {
    const fs::path& path;
    ~Removal() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  } const removal{temporary};
  write(temporary);
  try {
    move_entries(temporary, place);
  } catch (const fs::filesystem_error& failure) {
    refuse(failure.code());
  }
}

void write_standard_output(std::span<const std::byte> bytes) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (std::fflush(stdout) == 0 && written && std::ferror(stdout) == 0) return;
  const std::string why = errno == 0 ? "" : " (" + std::generic_category().message(errno) + ")";
  throw FailureError("standard output", "can't be written" + why, "check where it is redirected to");
}

void write_standard_output(std::string_view text) {
  write_standard_output(std::as_bytes(std::span(text)));
}

std::string file_stem(std::string_view text) {
  std::string stem;
  for (const char c : text) stem += std::isalnum(static_cast<unsigned char>(c)) || c == '.' ? c : '-';
  return stem;
}

}  // namespace shadewright
