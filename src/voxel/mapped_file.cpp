#include "mapped_file.h"

#include <fstream>
#include <string>

#include "shadewright/error.h"

#if defined(__unix__) || defined(__APPLE__)
#define SHADEWRIGHT_MMAP 1
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace shadewright::voxel {

MappedFile::MappedFile(const std::filesystem::path& file) {
#ifdef SHADEWRIGHT_MMAP
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    void* address = ::mmap(nullptr, size_t(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address != MAP_FAILED) bytes_ = {static_cast<const std::byte*>(address), size_t(status.st_size)};
  }
  if (descriptor >= 0) ::close(descriptor);
  if (!bytes_.empty()) return;
#endif
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
  if (size >= 0 && std::filesystem::is_regular_file(file)) {
    read_.resize(size_t(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(read_.data()), size);
  }
  if (!stream || size < 0 || !std::filesystem::is_regular_file(file))
    throw InputError(file.string(), "cannot be read", "check the path and its permissions");
  bytes_ = read_;
}

MappedFile::~MappedFile() {
#ifdef SHADEWRIGHT_MMAP
  if (read_.empty() && !bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
#endif
}

}  // namespace shadewright::voxel
