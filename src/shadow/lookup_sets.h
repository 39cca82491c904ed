// The descriptor sets of a look-up's own resources, one a frame in flight, and the image that it fills.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class LookupSets {
 public:
  /// Kinds of what is bound from binding `first` on.
  struct Part {
    uint32_t first = 0;
    std::vector<gpu::BindingKind> kinds;
  };

  LookupSets() = default;
  /// `count` sets for the shaders of any stage.
  LookupSets(const gpu::Device& device, std::span<const Part> parts, uint32_t count);
  LookupSets(LookupSets&&) noexcept = default;
  /// What was here before goes as it does in the destructor: the sets before their pool.
  LookupSets& operator=(LookupSets&& other) noexcept {
    std::swap(layout_, other.layout_);
    std::swap(pool_, other.pool_);
    std::swap(sets_, other.sets_);
    return *this;
  }

  vk::DescriptorSetLayout layout() const { return *layout_; }
  vk::DescriptorSet set(uint32_t slot) const { return *sets_[slot]; }

 private:
  vk::raii::DescriptorSetLayout layout_{nullptr};
  vk::raii::DescriptorPool pool_{nullptr};
  std::vector<vk::raii::DescriptorSet> sets_;
};

/// R8 of the camera's size, for a look-up to write and others to read.
gpu::Image make_visibility(const gpu::Device& device, const TechniqueOptions& options);

}  // namespace shadewright::shadow
