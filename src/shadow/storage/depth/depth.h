// depth: the map keeps the depth of the closest occluder (Williams, "Casting curved shadows on curved surfaces", 1978).
#pragma once

#include "shadow/storage/storage.h"

namespace shadewright::shadow {

class DepthStorage final : public Storage {
 public:
  DepthStorage(const gpu::Device& device, const StorageDesc& desc);

  void record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) override;
  std::vector<gpu::Binding> lookup_bindings() const override;
  std::vector<Allocation> allocations() const override;
  /// The map, near bright and empty black, layers one below the other.
  Picture debug_picture(std::string_view name) override;

 private:
  const gpu::Device& device_;
  gpu::Image map_;
  vk::raii::Sampler sampler_;
  CasterDraws& draws_;
};

}  // namespace shadewright::shadow
