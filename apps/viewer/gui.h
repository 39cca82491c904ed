// Dear ImGui in a window: controls that are drawn above its picture.
#pragma once

#include <memory>
#include <span>
#include <vector>

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

  /// Begins a frame: ImGui's calls follow, then `end`. `pressed` are the keys that went down since the last one, of
  /// which ImGui would miss those that are up again.
  void begin(std::span<const int> pressed);
  /// Closes the lists that are open; false if none is.
  bool close_lists();
  void end();
  /// Draws the last frame (see Window::present).
  void record(const vk::raii::CommandBuffer& commands, vk::ImageView view, vk::Extent2D size);

 private:
  struct Context;  ///< ImGui's own and its two backends
  const Window& window_;
  const gpu::Device& device_;
  vk::raii::RenderPass pass_{nullptr};
  vk::raii::DescriptorPool descriptors_{nullptr};
  vk::raii::Framebuffer framebuffer_{nullptr};  ///< of the last recorded frame
  std::unique_ptr<Context> context_;
  std::vector<int> released_;  ///< keys that were down for the last frame only because they had been since
};

}  // namespace shadewright::viewer
