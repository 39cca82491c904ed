#include "shadow/storage/storage.h"

#include <fmt/format.h>

#include <stdexcept>

#include "shadow/storage/depth/depth.h"
#include "shadow/storage/moments/moments.h"
#include "shadow/storage/subpixel/subpixel.h"
#include "shadow/storage/triangle/triangle.h"

namespace shadewright::shadow {

StorageTraits storage_traits(std::string_view storage) {
  using enum gpu::BindingKind;
  if (storage == "depth" || storage == "moments") return {{sampled_image}, {"shadow-map"}};
  if (storage == "subpixel")
    return {{sampled_image, sampled_image, uniform_buffer, storage_buffer},
            {"shadow-map", "decisions"},
            {"decided_by_one_texel", "decided_by_neighbours", "decided_by_recovery"},
            true,
            false};
  if (storage == "triangle")
    return {{sampled_image, sampled_image, sampled_image, sampled_image}, {"shadow-map"}, {}, false, false};
  throw std::logic_error(fmt::format("storage '{}' has shaders but no class", storage));
}

std::unique_ptr<Storage> make_storage(const gpu::Device& device, const StorageDesc& desc) {
  if (desc.spec.storage == "depth") return std::make_unique<DepthStorage>(device, desc);
  if (desc.spec.storage == "subpixel") return std::make_unique<SubpixelStorage>(device, desc);
  if (desc.spec.storage == "triangle") return std::make_unique<TriangleStorage>(device, desc);
  if (desc.spec.storage == "moments") return std::make_unique<MomentsStorage>(device, desc);
  throw std::logic_error(fmt::format("storage '{}' has shaders but no class", desc.spec.storage));
}

}  // namespace shadewright::shadow
