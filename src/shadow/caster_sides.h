// Which triangles of a view's casters are drawn where only one side of closed bodies is, and which of their edges are
// silhouettes: found by one pass before they are drawn, so that what is not drawn costs no vertex and no primitive.
#pragma once

#include <vector>

#include "shadewright/render/scene_gpu.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class CasterSides {
 public:
  /// For the casters of `scene`, which outlives this. `compacts`: the drawn triangles are listed one after the other,
  /// if they are not too many for one storage binding; else all are drawn, and the geometry stage leaves some out.
  /// `splits`: and small triangles are listed apart, by `find`.
  CasterSides(const render::SceneGpu& scene, bool compacts, bool splits, vk::DescriptorSetLayout lookup_layout);

  /// Finds the sides of what `draws` has found visible in `view`. They stay until the next call.
  /// `small_lists`: where small triangles are listed, if they are (SmallCasters::lists).
  void find(const vk::raii::CommandBuffer& commands, const render::CulledDraws& draws, uint32_t view, LightKind light,
            vk::DescriptorSet lookup_set, std::vector<gpu::Binding> small_lists) const;
  /// Whether there is a list to draw by `draw`.
  bool compacts() const { return bool{kept_draws_}; }
  /// Draws the listed triangles, with the scene's vertex inputs.
  void draw(const vk::raii::CommandBuffer& commands, const render::CulledDraws& draws) const;

  /// What storage/subpixel/scene_triangle.glsl reads, with what is drawn.
  std::vector<gpu::Binding> bindings(const gpu::Buffer& visible) const;
  std::vector<Allocation> allocations() const;

 private:
  const render::SceneGpu& scene_;
  gpu::ComputePass directional_pass_, positional_pass_;
  gpu::Buffer sides_, kept_indices_, kept_draws_;
};

}  // namespace shadewright::shadow
