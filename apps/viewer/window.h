// A window on the desktop and the images that it shows, by GLFW and a Vulkan swapchain.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shadewright/gpu/resources.h"

struct GLFWwindow;

namespace shadewright::viewer {

/// The connection to the desktop. One at a time.
class Desktop {
 public:
  /// FailureError where there is none.
  Desktop();
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// What an instance and a device must have to show something in a window (see gpu::DeviceOptions).
  static std::vector<std::string> instance_extensions();
  static std::vector<std::string> device_extensions();
  /// The largest window that fits the main screen beside its bars, in screen coordinates.
  static vk::Extent2D largest_window();
};

class Window {
 public:
  /// Opens a window of `size` screen coordinates; the device was made with the desktop's extensions. FailureError where
  /// the device can't show anything in it.
  Window(const Desktop& desktop, const gpu::Device& device, const std::string& title, vk::Extent2D size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool is_closing() const;
  /// Takes what the person did; waits for something up to `seconds` (0: does not).
  void take_events(double seconds);
  /// The keys (GLFW_KEY_*) that went down since the last call, however short.
  std::vector<int> take_pressed_keys() { return std::exchange(pressed_keys_, {}); }
  bool is_key_down(int key) const;
  void set_clipboard(const std::string& text);
  /// Pixels; 0 while it is minimized.
  vk::Extent2D size() const;
  GLFWwindow* handle() const { return window_.get(); }
  vk::Format format() const { return format_; }

  /// Draws on top of what is shown, into a view of this size that is a color attachment.
  using Overlay = std::function<void(const vk::raii::CommandBuffer& commands, vk::ImageView view, vk::Extent2D size)>;
  /// Shows `picture` (in transfer-source layout) as large as it fits, in its own proportions, and `overlay` above it.
  /// Waits until the device has drawn both. Does nothing while the window is minimized.
  void present(const gpu::Image& picture, const Overlay& overlay);

 private:
  struct Destroy {
    void operator()(GLFWwindow* window) const;
  };
  /// What there is of each image that the window shows in turn.
  struct Target {
    vk::Image image;
    vk::raii::ImageView view{nullptr};
    vk::raii::Semaphore drawn{nullptr};
  };

  void make_swapchain();
  bool try_present(const gpu::Image& picture, const Overlay& overlay);
  void draw(const Target& target, const gpu::Image& picture, const Overlay& overlay);

  const gpu::Device& device_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  vk::raii::SurfaceKHR surface_{nullptr};
  vk::Format format_ = vk::Format::eB8G8R8A8Unorm;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  vk::Extent2D extent_;
  std::vector<Target> targets_;
  vk::raii::CommandPool pool_{nullptr};
  vk::raii::CommandBuffer commands_{nullptr};
  vk::raii::Semaphore acquired_{nullptr};
  vk::raii::Fence finished_{nullptr};
  std::vector<int> pressed_keys_;
};

}  // namespace shadewright::viewer
