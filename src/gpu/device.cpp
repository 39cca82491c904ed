#include "shadewright/gpu/device.h"

#include <algorithm>
#include <cctype>
#include <mutex>
#include <span>

#include "shadewright/error.h"

namespace shadewright::gpu {

namespace {

constexpr uint32_t api_version = VK_API_VERSION_1_3;
const vk::QueueFlags queue_work = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
const char* const no_vulkan_mend =
    "install the Debian package mesa-vulkan-drivers (software device) or your GPU's driver";

DeviceType device_type(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return DeviceType::discrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return DeviceType::integrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return DeviceType::virtual_gpu;
    case vk::PhysicalDeviceType::eCpu:
      return DeviceType::cpu;
    default:
      return DeviceType::other;
  }
}

vk::raii::Context make_context() {
  try {
    return vk::raii::Context();
  } catch (const std::exception&) {
    throw FailureError("Vulkan", "there is no Vulkan loader (libvulkan.so.1)", "install the Debian package libvulkan1");
  }
}

std::vector<const char*> c_strings(std::span<const std::string> texts) {
  std::vector<const char*> result;
  for (const std::string& text : texts) result.push_back(text.c_str());
  return result;
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validation,
                                 std::span<const std::string> further_extensions = {}) {
  const vk::ApplicationInfo application("shadewright", 1, "shadewright", 1, api_version);
  std::vector<const char*> layers, extensions = c_strings(further_extensions);
  const vk::ValidationFeatureEnableEXT synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features(synchronization);
  vk::InstanceCreateInfo info({}, &application);
  if (validation) {
    layers.push_back("VK_LAYER_KHRONOS_validation");
    extensions.insert(extensions.end(), {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME});
    info.pNext = &features;
  }
  info.setPEnabledLayerNames(layers);
  info.setPEnabledExtensionNames(extensions);
  try {
    return vk::raii::Instance(context, info);
  } catch (const vk::LayerNotPresentError&) {
    throw FailureError("Vulkan", "the validation layer is missing",
                       "install the Debian package vulkan-validationlayers");
  } catch (const vk::SystemError& error) {
    throw FailureError("Vulkan", std::string("no instance can be made (") + error.what() + ")", no_vulkan_mend);
  }
}

/// Calls `visit` with the name and the value of each feature we need, so that checking and enabling share one list.
template <typename Visitor>
void visit_features(DeviceFeatures& f, Visitor visit) {
  visit("multiDrawIndirect", f.core.features.multiDrawIndirect);
  visit("drawIndirectFirstInstance", f.core.features.drawIndirectFirstInstance);
  visit("depthClamp", f.core.features.depthClamp);
  visit("shaderClipDistance", f.core.features.shaderClipDistance);
  visit("geometryShader", f.core.features.geometryShader);  // gl_PrimitiveID in fragment shaders
  visit("tessellationShader", f.core.features.tessellationShader);
  visit("shaderStorageImageExtendedFormats", f.core.features.shaderStorageImageExtendedFormats);
  visit("shaderDrawParameters", f.vulkan11.shaderDrawParameters);
  visit("scalarBlockLayout", f.vulkan12.scalarBlockLayout);
  visit("drawIndirectCount", f.vulkan12.drawIndirectCount);
  visit("bufferDeviceAddress", f.vulkan12.bufferDeviceAddress);
  visit("dynamicRendering", f.vulkan13.dynamicRendering);
  visit("synchronization2", f.vulkan13.synchronization2);
  visit("maintenance4", f.vulkan13.maintenance4);  // work group sizes as glslc writes them
}

void chain(DeviceFeatures& f) {
  f.core.pNext = &f.vulkan11;
  f.vulkan11.pNext = &f.vulkan12;
  f.vulkan12.pNext = &f.vulkan13;
}

void read_features(const vk::raii::PhysicalDevice& physical, DeviceFeatures& features) {
  chain(features);
  (*physical).getFeatures2(&features.core, *physical.getDispatcher());
}

/// "no NAME" for the first of `wanted` that the device lacks; empty if it has them all.
std::string missing_extension(const vk::raii::PhysicalDevice& physical, std::span<const char* const> wanted) {
  const auto extensions = physical.enumerateDeviceExtensionProperties();
  for (const std::string_view name : wanted)
    if (std::ranges::none_of(extensions, [&](const auto& e) { return std::string_view(e.extensionName) == name; }))
      return "no " + std::string(name);
  return "";
}

bool can_wide_atomics(const vk::raii::PhysicalDevice& physical) {
  DeviceFeatures features;
  read_features(physical, features);
  return features.core.features.shaderInt64 && features.vulkan12.shaderBufferInt64Atomics;
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, uint32_t index) {
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  return {index, properties.deviceName, std::string(driver.driverName) + " " + std::string(driver.driverInfo),
          device_type(properties.deviceType), Device::why_unusable(physical)};
}

uint32_t find_queue_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (uint32_t i = 0; i < families.size(); ++i)
    if ((families[i].queueFlags & queue_work) == queue_work) return i;
  throw FailureError("Vulkan device", "no queue does both graphics and compute", "choose another with --device");
}

const AdoptedDevice& with_all_handles(const AdoptedDevice& handles) {
  if (!handles.instance || !handles.physical_device || !handles.device || !handles.queue)
    throw InputError("adopted device", "instance, physical device, device or queue is missing", "give all four");
  return handles;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool selects(const std::string& select, const DeviceInfo& info) {
  const bool is_index =
      !select.empty() && std::all_of(select.begin(), select.end(), [](unsigned char c) { return std::isdigit(c); });
  if (is_index) return select == std::to_string(info.index);
  return lower(info.name).find(lower(select)) != std::string::npos;
}

/// Smaller is preferred.
int rank(DeviceType type) {
  switch (type) {
    case DeviceType::discrete:
      return 0;
    case DeviceType::integrated:
      return 1;
    case DeviceType::virtual_gpu:
      return 2;
    case DeviceType::cpu:
      return 3;
    default:
      return 4;
  }
}

DeviceInfo choose(const std::vector<DeviceInfo>& all, const std::string& select) {
  const DeviceInfo* best = nullptr;
  std::string names, reasons;
  for (const DeviceInfo& info : all) {
    names += (names.empty() ? "" : ", ") + std::to_string(info.index) + " " + info.name;
    if (!info.unusable.empty()) reasons += (reasons.empty() ? "" : ", ") + info.name + ": " + info.unusable;
    if (!selects(select, info)) continue;
    if (!select.empty() && !info.unusable.empty())
      throw InputError("--device " + select, info.name + " can't be used (" + info.unusable + ")",
                       "choose one of " + names);
    if (info.unusable.empty() && (!best || rank(info.type) < rank(best->type))) best = &info;
  }
  if (best) return *best;
  if (!select.empty() && !all.empty())
    throw InputError("--device " + select, "no such device", "choose one of " + names);
  throw FailureError("Vulkan", all.empty() ? "there is no device" : "no device can be used (" + reasons + ")",
                     no_vulkan_mend);
}

}  // namespace

struct Device::Messages {
  mutable std::mutex mutex;
  std::vector<std::string> texts;

  static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    auto& messages = *static_cast<Messages*>(self);
    const std::lock_guard lock(messages.mutex);
    messages.texts.emplace_back(data->pMessage);
    return VK_FALSE;
  }
};

std::string to_string(DeviceType type) {
  switch (type) {
    case DeviceType::discrete:
      return "discrete";
    case DeviceType::integrated:
      return "integrated";
    case DeviceType::virtual_gpu:
      return "virtual";
    case DeviceType::cpu:
      return "cpu";
    default:
      return "other";
  }
}

std::vector<DeviceInfo> Device::list() {
  const vk::raii::Context context = make_context();
  const vk::raii::Instance instance = make_instance(context, false);
  std::vector<DeviceInfo> result;
  for (const auto& physical : instance.enumeratePhysicalDevices())
    result.push_back(describe(physical, static_cast<uint32_t>(result.size())));
  return result;
}

std::string Device::why_unusable(const vk::raii::PhysicalDevice& physical) {
  if (physical.getProperties().apiVersion < api_version) return "no Vulkan 1.3";
  if (const std::string missing = missing_extension(physical, required_extensions()); !missing.empty()) return missing;
  DeviceFeatures features;
  read_features(physical, features);
  std::string missing;
  visit_features(features, [&](const char* name, vk::Bool32 value) {
    if (!value && missing.empty()) missing = std::string("no ") + name;
  });
  return missing;
}

std::vector<const char*> Device::required_extensions() {
  return {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
}

void Device::required_features(DeviceFeatures& features) {
  chain(features);
  visit_features(features, [](const char*, vk::Bool32& value) { value = VK_TRUE; });
}

Device::Device(const DeviceOptions& options) : context_(make_context()), messages_(std::make_unique<Messages>()) {
  instance_ = make_instance(context_, options.validation, options.instance_extensions);
  if (options.validation) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    messenger_ = vk::raii::DebugUtilsMessengerEXT(instance_, {{},
                                                              Severity::eWarning | Severity::eError,
                                                              Type::eValidation | Type::ePerformance,
                                                              &Messages::receive,
                                                              messages_.get()});
  }
  std::vector<DeviceInfo> all;
  const auto physicals = instance_.enumeratePhysicalDevices();
  std::vector<const char*> extensions = c_strings(options.device_extensions);
  for (const auto& physical : physicals) {
    all.push_back(describe(physical, static_cast<uint32_t>(all.size())));
    if (all.back().unusable.empty()) all.back().unusable = missing_extension(physical, extensions);
  }
  info_ = choose(all, options.select);
  physical_ = physicals[info_.index];
  queue_family_ = find_queue_family(physical_);

  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue_info({}, queue_family_, 1, &priority);
  const auto required = required_extensions();
  extensions.insert(extensions.end(), required.begin(), required.end());
  DeviceFeatures features;
  required_features(features);
  double_precision_ = options.optional_features && physical_.getFeatures().shaderFloat64 == VK_TRUE;
  features.core.features.shaderFloat64 = double_precision_;
  wide_atomics_ = options.optional_features && can_wide_atomics(physical_);
  features.core.features.shaderInt64 = features.vulkan12.shaderBufferInt64Atomics = wide_atomics_;
  vk::DeviceCreateInfo device_info({}, queue_info, {}, extensions);
  device_info.pNext = &features.core;
  device_ = vk::raii::Device(physical_, device_info);
  queue_ = vk::raii::Queue(device_, queue_family_, 0);
  memory_ = physical_.getMemoryProperties();
  nanoseconds_per_tick_ = static_cast<double>(physical_.getProperties().limits.timestampPeriod);
}

// The outer constructor checks: what it throws finds a whole object, whose destructor lets go of the caller's handles.
Device::Device(const AdoptedDevice& handles) : Device(with_all_handles(handles), Unchecked{}) {
  if (!info_.unusable.empty())
    throw InputError("adopted device " + info_.name, "it can't be used (" + info_.unusable + ")",
                     "choose one that can");
  const auto families = physical_.getQueueFamilyProperties();
  if (queue_family_ >= families.size() || (families[queue_family_].queueFlags & queue_work) != queue_work)
    throw InputError("adopted device " + info_.name, "its queue does not do both graphics and compute",
                     "choose another family");
}

Device::Device(const AdoptedDevice& handles, Unchecked)
    : context_(make_context()),
      messages_(std::make_unique<Messages>()),
      owned_(false),
      double_precision_(handles.double_precision),
      wide_atomics_(handles.wide_atomics),
      instance_(context_, handles.instance),
      physical_(instance_, handles.physical_device),
      device_(physical_, handles.device),
      queue_(device_, handles.queue),
      queue_family_(handles.queue_family) {
  info_ = describe(physical_, 0);
  memory_ = physical_.getMemoryProperties();
  nanoseconds_per_tick_ = static_cast<double>(physical_.getProperties().limits.timestampPeriod);
}

Device::~Device() {
  if (owned_) return;
  device_.release();
  instance_.release();
}

uint32_t Device::memory_type(uint32_t type_bits, vk::MemoryPropertyFlags wanted) const {
  for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
    if ((type_bits & (1u << i)) && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw FailureError(info_.name, "no memory type fits " + vk::to_string(wanted), "choose another device with --device");
}

std::vector<std::string> Device::validation_messages() const {
  const std::lock_guard lock(messages_->mutex);
  return messages_->texts;
}

}  // namespace shadewright::gpu
