#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "shadewright/error.h"

namespace shadewright::viewer {

namespace {

std::string last_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW does not say why";
}

/// Everything before is finished and seen before anything after, with the image in another layout.
void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
  const vk::PipelineStageFlags2 all = vk::PipelineStageFlagBits2::eAllCommands;
  const vk::AccessFlags2 written = vk::AccessFlagBits2::eMemoryWrite;
  const vk::ImageMemoryBarrier2 barrier(all, written, all, written | vk::AccessFlagBits2::eMemoryRead, from, to,
                                        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                        {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
  commands.pipelineBarrier2({{}, {}, {}, barrier});
}

/// The corners of `size` scaled to fit into the middle of `room`.
std::array<vk::Offset3D, 2> fitted(vk::Extent2D size, vk::Extent2D room) {
  const double scale =
      std::min(static_cast<double>(room.width) / size.width, static_cast<double>(room.height) / size.height);
  const auto width = std::clamp(static_cast<int32_t>(size.width * scale + 0.5), 1, static_cast<int32_t>(room.width));
  const auto height = std::clamp(static_cast<int32_t>(size.height * scale + 0.5), 1, static_cast<int32_t>(room.height));
  const int32_t x = (static_cast<int32_t>(room.width) - width) / 2,
                y = (static_cast<int32_t>(room.height) - height) / 2;
  return {vk::Offset3D(x, y, 0), vk::Offset3D(x + width, y + height, 1)};
}

}  // namespace

Desktop::Desktop() {
  if (!glfwInit())
    throw FailureError("window", "there is no desktop (" + last_problem() + ")",
                       "start it on one, or use shadewright render and compare, which need none");
  if (glfwVulkanSupported()) return;
  const std::string problem = last_problem();
  glfwTerminate();
  throw FailureError("window", "this desktop shows nothing that Vulkan draws (" + problem + ")",
                     "install the Debian package mesa-vulkan-drivers or your GPU's driver");
}

Desktop::~Desktop() {
  glfwTerminate();
}

std::vector<std::string> Desktop::instance_extensions() {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

std::vector<std::string> Desktop::device_extensions() {
  return {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
}

vk::Extent2D Desktop::largest_window() {
  int x = 0, y = 0, width = 0, height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  if (width <= 0 || height <= 0) return {1280, 720};
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void Window::Destroy::operator()(GLFWwindow* window) const {
  glfwDestroyWindow(window);
}

Window::Window(const Desktop&, const gpu::Device& device, const std::string& title, vk::Extent2D size)
    : device_(device),
      acquired_(device.handle(), vk::SemaphoreCreateInfo{}),
      finished_(device.handle(), vk::FenceCreateInfo{}) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  window_.reset(
      glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr, nullptr));
  if (!window_) throw FailureError("window", "it can't be opened (" + last_problem() + ")", "try a smaller --size");
  glfwSetWindowUserPointer(window_.get(), &pressed_keys_);
  glfwSetKeyCallback(window_.get(), [](GLFWwindow* self, int key, int, int action, int) {
    if (action == GLFW_PRESS) static_cast<std::vector<int>*>(glfwGetWindowUserPointer(self))->push_back(key);
  });
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(*device.instance(), window_.get(), nullptr, &surface) != VK_SUCCESS)
    throw FailureError("window", "Vulkan can't draw into it (" + last_problem() + ")", "choose another --device");
  surface_ = vk::raii::SurfaceKHR(device.instance(), surface);
  if (!device.physical().getSurfaceSupportKHR(device.queue_family(), *surface_))
    throw FailureError(device.info().name, "it can't show anything in this window", "choose another --device");

  // Pictures are encoded as sRGB already: the images that take them must not encode them again.
  const auto formats = device.physical().getSurfaceFormatsKHR(*surface_);
  const auto fits = [](const vk::SurfaceFormatKHR& f) {
    return (f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm) &&
           f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear;
  };
  const auto format = std::ranges::find_if(formats, fits);
  if (format == formats.end())
    throw FailureError(device.info().name, "it shows no 8-bit colours in this window", "choose another --device");
  format_ = format->format;

  pool_ = vk::raii::CommandPool(device.handle(),
                                {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queue_family()});
  vk::raii::CommandBuffers buffers(device.handle(), {*pool_, vk::CommandBufferLevel::ePrimary, 1});
  commands_ = std::move(buffers.front());
}

Window::~Window() {
  device_.handle().waitIdle();
}

bool Window::is_closing() const {
  return glfwWindowShouldClose(window_.get()) != 0;
}

void Window::take_events(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

bool Window::is_key_down(int key) const {
  return glfwGetKey(window_.get(), key) == GLFW_PRESS;
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_.get(), text.c_str());
}

vk::Extent2D Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_.get(), &width, &height);
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void Window::make_swapchain() {
  const vk::raii::Device& handle = device_.handle();
  handle.waitIdle();
  const vk::SurfaceCapabilitiesKHR can = device_.physical().getSurfaceCapabilitiesKHR(*surface_);
  const vk::Extent2D own = size(), least = can.minImageExtent, largest = can.maxImageExtent;
  extent_ = can.currentExtent.width != UINT32_MAX ? can.currentExtent
                                                  : vk::Extent2D(std::clamp(own.width, least.width, largest.width),
                                                                 std::clamp(own.height, least.height, largest.height));
  if (extent_.width == 0 || extent_.height == 0) {  // minimized meanwhile
    targets_.clear();
    return;
  }
  const uint32_t most = can.maxImageCount == 0 ? UINT32_MAX : can.maxImageCount;
  using Usage = vk::ImageUsageFlagBits;
  const vk::CompositeAlphaFlagBitsKHR alpha = can.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque
                                                  ? vk::CompositeAlphaFlagBitsKHR::eOpaque
                                                  : vk::CompositeAlphaFlagBitsKHR::eInherit;
  const vk::SwapchainCreateInfoKHR info({}, *surface_, std::min(can.minImageCount + 1, most), format_,
                                        vk::ColorSpaceKHR::eSrgbNonlinear, extent_, 1,
                                        Usage::eColorAttachment | Usage::eTransferDst, vk::SharingMode::eExclusive, {},
                                        can.currentTransform, alpha, vk::PresentModeKHR::eFifo, VK_TRUE, *swapchain_);
  swapchain_ = vk::raii::SwapchainKHR(handle, info);
  targets_.clear();
  for (const VkImage image : swapchain_.getImages())
    targets_.push_back(
        {image,
         {handle, {{}, image, vk::ImageViewType::e2D, format_, {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}}},
         {handle, vk::SemaphoreCreateInfo{}}});
}

void Window::present(const gpu::Image& picture, const Overlay& overlay) {
  const vk::Extent2D now = size();
  if (now.width == 0 || now.height == 0) return;
  if (targets_.empty() || extent_ != now) make_swapchain();
  if (targets_.empty()) return;
  // A window that changed its size meanwhile wants other images; the next frame tries again where these do not fit
  // either.
  if (!try_present(picture, overlay)) make_swapchain();
}

bool Window::try_present(const gpu::Image& picture, const Overlay& overlay) {
  try {
    const auto [result, index] = swapchain_.acquireNextImage(UINT64_MAX, *acquired_);
    const Target& target = targets_[index];
    draw(target, picture, overlay);
    const vk::PresentInfoKHR info(*target.drawn, *swapchain_, index);
    return device_.queue().presentKHR(info) == vk::Result::eSuccess && result == vk::Result::eSuccess;
  } catch (const vk::OutOfDateKHRError&) {
    return false;
  }
}

void Window::draw(const Target& target, const gpu::Image& picture, const Overlay& overlay) {
  using Layout = vk::ImageLayout;
  commands_.reset();
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  transition(commands_, target.image, Layout::eUndefined, Layout::eTransferDstOptimal);
  const vk::ImageSubresourceRange whole(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
  commands_.clearColorImage(target.image, Layout::eTransferDstOptimal, vk::ClearColorValue(0.1f, 0.1f, 0.1f, 1.0f),
                            whole);
  if (picture) {
    transition(commands_, target.image, Layout::eTransferDstOptimal, Layout::eTransferDstOptimal);
    const vk::ImageSubresourceLayers layer(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
    const vk::Extent2D size = picture.extent();
    const std::array source{vk::Offset3D(0, 0, 0),
                            vk::Offset3D(static_cast<int32_t>(size.width), static_cast<int32_t>(size.height), 1)};
    const std::array corners = fitted(size, extent_);
    // Pixels stay pixels where they are enlarged.
    const bool enlarged = corners[1].x - corners[0].x >= static_cast<int32_t>(size.width);
    commands_.blitImage(picture.handle(), Layout::eTransferSrcOptimal, target.image, Layout::eTransferDstOptimal,
                        vk::ImageBlit(layer, source, layer, corners),
                        enlarged ? vk::Filter::eNearest : vk::Filter::eLinear);
  }
  transition(commands_, target.image, Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
  overlay(commands_, *target.view, extent_);
  transition(commands_, target.image, Layout::eColorAttachmentOptimal, Layout::ePresentSrcKHR);
  commands_.end();

  const vk::PipelineStageFlags waiting = vk::PipelineStageFlagBits::eAllCommands;
  device_.handle().resetFences(*finished_);
  device_.queue().submit(vk::SubmitInfo(*acquired_, waiting, *commands_, *target.drawn), *finished_);
  if (device_.handle().waitForFences(*finished_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
    throw FailureError(device_.info().name, "the device did not finish its work");
}

}  // namespace shadewright::viewer
