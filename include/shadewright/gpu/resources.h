// Buffers and images with their memory and a name, by which the report lists their bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>

#include "shadewright/allocation.h"
#include "shadewright/gpu/device.h"

namespace shadewright::gpu {

enum class HostAccess { none, write, read };

/// What one storage binding holds on every device (the limit that Vulkan promises).
inline constexpr uint64_t max_binding_bytes = uint64_t{1} << 27;

/// A buffer with memory of its own. Storage, transfer, vertex, index, indirect, uniform and address use are always
/// allowed.
class Buffer {
 public:
  Buffer() = default;
  /// `bytes` is rounded up to 16. With host access the memory stays mapped and coherent.
  Buffer(const Device& device, std::string name, uint64_t bytes, HostAccess access = HostAccess::none);

  vk::Buffer handle() const { return *buffer_; }
  uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }
  Allocation allocation() const { return {name_, size_}; }
  explicit operator bool() const { return size_ != 0; }
  /// For shaders with buffer references.
  uint64_t device_address(const Device& device) const;

  /// The mapped bytes seen as T (host access only).
  template <typename T>
  std::span<T> mapped() const {
    return {static_cast<T*>(mapped_), static_cast<size_t>(size_ / sizeof(T))};
  }

 private:
  std::string name_;
  uint64_t size_ = 0;
  vk::raii::Buffer buffer_{nullptr};
  vk::raii::DeviceMemory memory_{nullptr};
  void* mapped_ = nullptr;
};

struct ImageDesc {
  std::string name;
  vk::Format format = vk::Format::eUndefined;
  uint32_t width = 1, height = 1, layers = 1;
  vk::ImageUsageFlags usage;
  bool array_view = false;  ///< the view is an array even with one layer (shadow maps)
};

/// A 2-D image or array with memory of its own. Knows the layout it was last put into, so that a transition is one
/// call.
class Image {
 public:
  Image() = default;
  Image(const Device& device, const ImageDesc& desc);

  vk::Image handle() const { return *image_; }
  /// All layers. None for an image that is only copied from and to.
  vk::ImageView view() const { return *view_; }
  /// One layer, to render into.
  vk::ImageView layer_view(uint32_t layer) const { return *layer_views_[layer]; }
  const ImageDesc& desc() const { return desc_; }
  vk::ImageAspectFlags aspect() const { return aspect_; }
  vk::Extent2D extent() const { return {desc_.width, desc_.height}; }
  Allocation allocation() const { return {desc_.name, bytes_}; }
  explicit operator bool() const { return bytes_ != 0; }

  /// Puts the whole image into `layout`, after everything before and before everything after. `discard` forgets the
  /// content.
  void transition(const vk::raii::CommandBuffer& commands, vk::ImageLayout layout, bool discard = false);

 private:
  ImageDesc desc_;
  vk::ImageAspectFlags aspect_;
  vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
  uint64_t bytes_ = 0;
  vk::raii::Image image_{nullptr};
  vk::raii::DeviceMemory memory_{nullptr};
  vk::raii::ImageView view_{nullptr};
  std::vector<vk::raii::ImageView> layer_views_;
};

/// Everything written before is seen by everything after.
void memory_barrier(const vk::raii::CommandBuffer& commands);

/// Copies `data` to the start of a device-local `buffer` through a staging buffer, and waits.
void upload(const Device& device, const Buffer& buffer, std::span<const std::byte> data);

/// Fills the first layer of `image` with tightly packed rows, and waits. Leaves it in shader-read layout.
void upload(const Device& device, Image& image, std::span<const std::byte> data);

template <typename T>
Buffer make_buffer(const Device& device, std::string name, std::span<const T> data) {
  static_assert(std::is_trivially_copyable_v<T>);
  Buffer buffer(device, std::move(name), std::max<uint64_t>(data.size_bytes(), 16));
  if (!data.empty()) upload(device, buffer, std::as_bytes(data));
  return buffer;
}

/// Reads one layer of `image` back and waits: tightly packed rows of `bytes_per_pixel`. Leaves it in transfer-source
/// layout.
std::vector<std::byte> read_back(const Device& device, Image& image, uint32_t bytes_per_pixel, uint32_t layer = 0);
/// Reads the first `bytes` of `buffer` back and waits.
std::vector<std::byte> read_back(const Device& device, const Buffer& buffer, uint64_t bytes);

/// Records `record` into a command buffer of its own, submits it and waits. For set-up work, not for frames.
void submit_and_wait(const Device& device, const std::function<void(const vk::raii::CommandBuffer&)>& record);

}  // namespace shadewright::gpu
