// A Vulkan 1.3 device with one queue: found and owned by us, or wrapped around handles that someone else owns.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shadewright/gpu/vulkan.h"

namespace shadewright::gpu {

enum class DeviceType { discrete, integrated, virtual_gpu, cpu, other };

/// "discrete", "integrated", "virtual", "cpu" or "other", as the report prints it.
std::string to_string(DeviceType type);

/// A device that the Vulkan loader offers.
struct DeviceInfo {
  uint32_t index = 0;  ///< in the order the loader lists them
  std::string name;
  std::string driver;
  DeviceType type = DeviceType::other;
  std::string unusable;  ///< why it can't be used, one phrase; empty = usable
};

struct DeviceOptions {
  std::string select;  ///< part of a name (any case) or an index; empty = discrete, then integrated, then CPU
  bool validation =
      false;  ///< turn the Khronos validation layer on, with synchronization checks; messages are collected
  bool optional_features = true;  ///< false: only what every device must have, as if this one had no more
  /// Further ones, as a window system asks for them. A device without these can't be used.
  std::vector<std::string> instance_extensions = {}, device_extensions = {};
};

/// Handles that the caller owns and keeps alive for as long as the Device. The device must have been created with
/// Vulkan 1.3, the extensions of `Device::required_extensions()` and the features that `Device::required_features`
/// sets. The queue does graphics and compute. Calls that wait for the device (uploads, `read_back`, a Recorder that
/// owns its command buffers) submit to it: the caller submits from no other thread meanwhile.
struct AdoptedDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  bool double_precision = false;  ///< the device was created with shaderFloat64
  bool wide_atomics = false;      ///< the device was created with shaderInt64 and shaderBufferInt64Atomics
};

/// The chain of feature structures to create a VkDevice with; not movable, as the chain points into itself.
struct DeviceFeatures {
  vk::PhysicalDeviceFeatures2 core;
  vk::PhysicalDeviceVulkan11Features vulkan11;
  vk::PhysicalDeviceVulkan12Features vulkan12;
  vk::PhysicalDeviceVulkan13Features vulkan13;

  DeviceFeatures() = default;
  DeviceFeatures(const DeviceFeatures&) = delete;
  DeviceFeatures& operator=(const DeviceFeatures&) = delete;
};

// Vulkan-Hpp's classes have more members where asserts are on. A program and a library that differ in NDEBUG would read
// each other's objects wrongly; so the name says it, and they do not link.
#ifdef NDEBUG
inline namespace asserts_off {
#else
inline namespace asserts_on {
#endif

class Device {
 public:
  /// Everything the loader offers. Throws FailureError naming the Debian package when there is no Vulkan at all.
  static std::vector<DeviceInfo> list();

  /// Finds and owns a device. InputError when `select` fits none, FailureError when none is usable.
  explicit Device(const DeviceOptions& options = {});
  /// Wraps a device that the caller owns; nothing of it is destroyed here. InputError when a handle is missing, or the
  /// physical device can't do what is required.
  explicit Device(const AdoptedDevice& handles);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Why a physical device can't be used, one phrase; empty = usable. For callers who choose one to be adopted.
  static std::string why_unusable(const vk::raii::PhysicalDevice& physical);
  /// What a device to be adopted must be created with: extensions, and features, chained from `features.core`. A caller
  /// sets more of them afterwards, as needed.
  static std::vector<const char*> required_extensions();
  static void required_features(DeviceFeatures& features);

  const vk::raii::Device& handle() const { return device_; }
  const vk::raii::Instance& instance() const { return instance_; }
  const vk::raii::PhysicalDevice& physical() const { return physical_; }
  const vk::raii::Queue& queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }
  const DeviceInfo& info() const { return info_; }
  /// True where timestamps are not to be trusted and stages are timed by their own submission (a CPU device).
  bool is_cpu() const { return info_.type == DeviceType::cpu; }
  /// True where shaders may use 64-bit floats.
  bool has_double_precision() const { return double_precision_; }
  /// True where shaders may use 64-bit atomics on buffers.
  bool has_wide_atomics() const { return wide_atomics_; }
  double nanoseconds_per_tick() const { return nanoseconds_per_tick_; }

  /// Index of a memory type among `type_bits` that has `wanted`. FailureError when there is none.
  uint32_t memory_type(uint32_t type_bits, vk::MemoryPropertyFlags wanted) const;

  /// What the validation layer said so far (warnings and errors). Always empty without validation.
  std::vector<std::string> validation_messages() const;

 private:
  struct Messages;
  struct Unchecked {};
  Device(const AdoptedDevice& handles, Unchecked);

  vk::raii::Context context_;
  std::unique_ptr<Messages> messages_;
  bool owned_ = true;
  bool double_precision_ = false, wide_atomics_ = false;
  vk::raii::Instance instance_{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
  vk::raii::PhysicalDevice physical_{nullptr};
  vk::raii::Device device_{nullptr};
  vk::raii::Queue queue_{nullptr};
  uint32_t queue_family_ = 0;
  DeviceInfo info_;
  double nanoseconds_per_tick_ = 1;
  vk::PhysicalDeviceMemoryProperties memory_;
};

}  // namespace asserts_off / asserts_on

}  // namespace shadewright::gpu
