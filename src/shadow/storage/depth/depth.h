// depth: the map keeps the depth of the closest occluder (Williams, "Casting curved shadows on curved surfaces", 1978).
#pragma once

#include <optional>

#include "shadewright/render/scene_gpu.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class DepthStorage {
 public:
  /// A map of `resolution` x `resolution` texels with `layers` layers, drawn with the casters' shader `vertex`
  /// (SPIR-V).
  DepthStorage(const gpu::Device& device, uint32_t resolution, uint32_t layers, uint32_t frames_in_flight,
               std::span<const uint32_t> vertex, vk::DescriptorSetLayout lookup_layout);

  /// Host work of a frame: which clusters each view draws.
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views);
  /// Records culling and the drawing of all views; the map is left in shader-read layout.
  void record(const Frame& frame, uint32_t slot, std::span<const MapView> views, vk::DescriptorSet lookup_set,
              gpu::Recorder& recorder);

  /// The map as a picture, near bright and empty black, six faces one below the other. Waits.
  Picture picture();
  const gpu::Image& map() const { return map_; }
  std::vector<Allocation> allocations() const;

 private:
  void draw_view(const vk::raii::CommandBuffer& commands, const Frame& frame, const MapView& view, uint32_t index,
                 vk::DescriptorSet lookup_set);

  const gpu::Device& device_;
  uint32_t frames_in_flight_;
  gpu::Image map_;
  gpu::GraphicsPass pass_;
  std::optional<render::CulledDraws> draws_;
  const render::SceneGpu* scene_ = nullptr;  ///< whose draws these are
};

}  // namespace shadewright::shadow
