// libFuzzer target: any bytes either open as a shadow whose look-ups stay inside its memory, or are refused with an
// InputError. Checksums are not checked, or nothing would get past them.
#include <cstring>
#include <memory>

#include "shadewright/error.h"
#include "voxel/file_format.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace shadewright;
  // Sections need the alignment that a mapped file has.
  const auto aligned = std::make_unique<uint64_t[]>(size / 8 + 1);
  std::memcpy(aligned.get(), data, size);
  try {
    const voxel::VoxelShadow shadow = voxel::parse({reinterpret_cast<const std::byte*>(aligned.get()), size}, "fuzz",
                                                   {uint64_t(64) << 20, false}, nullptr);
    const int32_t step = int32_t(shadow.light().size() / 16);
    for (int32_t z = 0; z < 16; ++z)
      for (int32_t x = 0; x < 16; ++x)
        (void)shadow.filtered({x * step, (x ^ z) * step, z * step}, shadow.properties().max_filter);
  } catch (const InputError&) {
  }
  return 0;
}
