#include "shadewright/files.h"

#include <cctype>
#include <fstream>
#include <system_error>

#include "shadewright/error.h"

namespace shadewright {

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::error_code error;
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

std::string file_stem(std::string_view text) {
  std::string stem;
  for (const char c : text) stem += std::isalnum(static_cast<unsigned char>(c)) || c == '.' ? c : '-';
  return stem;
}

}  // namespace shadewright
