#include "shadow/storage/storage.h"

#include <fmt/format.h>

#include <stdexcept>

#include "shadow/storage/depth/depth.h"

namespace shadewright::shadow {

StorageTraits storage_traits(std::string_view storage) {
  if (storage == "depth") return {{gpu::BindingKind::sampled_image}, {"shadow-map"}};
  throw std::logic_error(fmt::format("storage '{}' has shaders but no class", storage));
}

std::unique_ptr<Storage> make_storage(const gpu::Device& device, const StorageDesc& desc) {
  if (desc.spec.storage == "depth") return std::make_unique<DepthStorage>(device, desc);
  throw std::logic_error(fmt::format("storage '{}' has shaders but no class", desc.spec.storage));
}

}  // namespace shadewright::shadow
