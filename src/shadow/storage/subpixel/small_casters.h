// The triangles of a view that cover few texels, rasterized conservatively by a compute pass: each texel's least
// minimum depth and whose it is, in one 64-bit word. A pass over the tiles that hold any then codes each texel once,
// where the geometry stage's triangles are coded in every texel that they meet. The map's bits are the same, unless
// several triangles have the same minimum. Lattice at 1024: frames that are nearly all map take 0.64 of the time.
#pragma once

#include <vector>

#include "shadewright/render/scene_gpu.h"
#include "shadewright/shadow/technique.h"
#include "shadow/caster_draws.h"

namespace shadewright::shadow {

class SmallCasters {
 public:
  /// Whether the device has what it takes, and the lists of all of the scene's triangles are not too large.
  static bool serves(const render::SceneGpu& scene, const MapExtent& extent);

  /// For casters of `scene`, which outlives this, drawn into one layer of `desc.extent` at a time.
  SmallCasters(const render::SceneGpu& scene, const CasterPipelineDesc& desc);

  /// What caster_sides.comp writes: the small triangles of each place in the list of visible instances.
  std::vector<gpu::Binding> lists() const;
  /// Finds what each texel keeps of them, once they are listed.
  void rasterize(const vk::raii::CommandBuffer& commands, vk::DescriptorSet lookup_set) const;
  /// Draws these texels, inside a rendering.
  void draw(const vk::raii::CommandBuffer& commands, uint32_t view, vk::DescriptorSet lookup_set) const;
  std::vector<Allocation> allocations() const;

 private:
  const render::SceneGpu& scene_;
  glm::uvec2 size_;  ///< of a layer, texels
  uint32_t tile_count_;
  gpu::Buffer triangles_, lists_, kept_, marked_, tiles_;
  gpu::ComputePass clear_, rasterize_, list_tiles_;
  gpu::GraphicsPass pass_;
};

}  // namespace shadewright::shadow
