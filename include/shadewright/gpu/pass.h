// Pipelines with their bindings: a compute pass is one shader and one call to dispatch it; a graphics pass draws
// triangles.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <variant>
#include <vector>

#include "shadewright/gpu/resources.h"

namespace shadewright::gpu {

enum class BindingKind { storage_buffer, uniform_buffer, sampled_image, storage_image };

/// What is bound at one binding of set 0, in order.
struct Binding {
  BindingKind kind;
  vk::Buffer buffer;
  vk::ImageView view;
  vk::Sampler sampler;
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;
  vk::DeviceSize bytes = VK_WHOLE_SIZE;  ///< of the buffer, from its beginning

  static Binding storage(const Buffer& buffer) { return {BindingKind::storage_buffer, buffer.handle(), {}, {}}; }
  static Binding uniform(const Buffer& buffer, vk::DeviceSize bytes = VK_WHOLE_SIZE) {
    return {BindingKind::uniform_buffer, buffer.handle(), {}, {}, {}, bytes};
  }
  static Binding sampled(vk::ImageView view, vk::Sampler sampler) {
    return {BindingKind::sampled_image, {}, view, sampler, vk::ImageLayout::eShaderReadOnlyOptimal};
  }
  static Binding storage(vk::ImageView view) {
    return {BindingKind::storage_image, {}, view, {}, vk::ImageLayout::eGeneral};
  }
};

vk::DescriptorType descriptor_type(BindingKind kind);

/// A descriptor set layout of `kinds` at bindings 0, 1, ... for `stages`; `push` makes it a push descriptor layout.
vk::raii::DescriptorSetLayout make_set_layout(const Device& device, std::span<const BindingKind> kinds,
                                              vk::ShaderStageFlags stages, bool push);

/// Writes bindings `first`, `first` + 1, ... of a set that no recorded command reads.
void write_set(const Device& device, vk::DescriptorSet set, uint32_t first, std::span<const Binding> bindings);

/// Clamped sampler; outside the image a depth map reads 1, which is lit.
vk::raii::Sampler make_sampler(const Device& device, vk::Filter filter);

/// One compute shader whose set 0 is pushed at each dispatch. `sets` are further layouts (set 1, ...) that the caller
/// binds; `constants` are the shader's specialization constants 0, 1, ..., as far as it has them.
class ComputePass {
 public:
  ComputePass() = default;
  ComputePass(const Device& device, std::span<const uint32_t> spirv, const std::vector<BindingKind>& kinds,
              uint32_t push_bytes = 0, std::span<const vk::DescriptorSetLayout> sets = {},
              std::initializer_list<uint32_t> constants = {});

  /// Binds, pushes and dispatches `groups` work groups. `push` must have the size given at construction.
  void dispatch(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                std::span<const std::byte> push, vk::Extent3D groups,
                std::span<const vk::DescriptorSet> sets = {}) const;
  /// The same with as many work groups as stand in `buffer` at `offset` bytes (VkDispatchIndirectCommand).
  void dispatch_indirect(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                         std::span<const std::byte> push, const Buffer& buffer, uint64_t offset,
                         std::span<const vk::DescriptorSet> sets = {}) const;
  explicit operator bool() const { return *pipeline_; }

 private:
  void bind(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings, std::span<const std::byte> push,
            std::span<const vk::DescriptorSet> sets) const;

  vk::raii::DescriptorSetLayout set_layout_{nullptr};
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Pipeline pipeline_{nullptr};
};

struct GraphicsDesc {
  /// SPIR-V; those left empty are left out. With tessellation, three vertices make a patch.
  std::span<const uint32_t> vertex, tessellation_control, tessellation_evaluation, geometry, fragment;
  std::vector<BindingKind> kinds;             ///< of the pushed set 0, for all stages
  std::vector<vk::DescriptorSetLayout> sets;  ///< further sets
  uint32_t push_bytes = 0;
  std::vector<vk::VertexInputBindingDescription> vertex_bindings;
  std::vector<vk::VertexInputAttributeDescription> vertex_attributes;
  std::vector<uint32_t> constants;  ///< specialization constants 0, 1, ... of all stages
  std::vector<vk::Format> colors;
  vk::Format depth = vk::Format::eD32Sfloat;
  vk::CompareOp depth_compare = vk::CompareOp::eLess;
  bool depth_clamp = false;
};

/// Triangles, two-sided, with a dynamic viewport.
class GraphicsPass {
 public:
  GraphicsPass() = default;
  GraphicsPass(const Device& device, const GraphicsDesc& desc);

  /// Binds the pipeline, its pushed set and constants. Draw calls follow.
  void bind(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings, std::span<const std::byte> push,
            std::span<const vk::DescriptorSet> sets = {}) const;
  /// Replaces the push constants between draws.
  void push(const vk::raii::CommandBuffer& commands, std::span<const std::byte> push) const;

 private:
  vk::raii::DescriptorSetLayout set_layout_{nullptr};
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Pipeline pipeline_{nullptr};
};

/// The bytes of one trivially copyable value, for push constants.
template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span<const T>(&value, 1));
}

/// Work groups of `size` that cover `extent`.
inline uint32_t groups(uint32_t extent, uint32_t size) {
  return (extent + size - 1) / size;
}

}  // namespace shadewright::gpu
