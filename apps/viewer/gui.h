// Dear ImGui in a window: controls that are drawn above its picture.
#pragma once

#include <memory>

#include "shadewright/gpu/device.h"
#include "window.h"

namespace shadewright::viewer {

class Gui {
 public:
  /// One at a time.
  Gui(const Window& window, const gpu::Device& device);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Begins a frame: ImGui's calls follow, then `end`.
  void begin();
  void end();
  /// Draws the last frame (see Window::present).
  void record(const vk::raii::CommandBuffer& commands, vk::ImageView view, vk::Extent2D size);

 private:
  struct Context;  ///< ImGui's own and its two backends
  const gpu::Device& device_;
  vk::raii::RenderPass pass_{nullptr};
  vk::raii::DescriptorPool descriptors_{nullptr};
  vk::raii::Framebuffer framebuffer_{nullptr};  ///< of the last recorded frame
  std::unique_ptr<Context> context_;
};

}  // namespace shadewright::viewer
