#include "gui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <iterator>

#include "shadewright/error.h"

namespace shadewright::viewer {

namespace {

void check(VkResult result) {
  if (result != VK_SUCCESS)
    throw FailureError("window", "its controls can't be drawn (" + vk::to_string(vk::Result(result)) + ")");
}

/// ImGui's backend wants a render pass: one attachment, drawn on top of what is there.
vk::raii::RenderPass make_pass(const gpu::Device& device, vk::Format format) {
  using Layout = vk::ImageLayout;
  const vk::AttachmentDescription attachment({}, format, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eLoad,
                                             vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                             vk::AttachmentStoreOp::eDontCare, Layout::eColorAttachmentOptimal,
                                             Layout::eColorAttachmentOptimal);
  const vk::AttachmentReference reference(0, Layout::eColorAttachmentOptimal);
  const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
  return {device.handle(), vk::RenderPassCreateInfo({}, attachment, subpass)};
}

}  // namespace

struct Gui::Context {
  Context(const Window& window, const gpu::Device& device, vk::RenderPass pass, vk::DescriptorPool descriptors) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // nothing is left in the folder that one happens to be in
    float x_scale = 1, y_scale = 1;
    glfwGetWindowContentScale(window.handle(), &x_scale, &y_scale);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(x_scale);
    ImGui::GetStyle().WindowRounding = 4 * x_scale;
    ImFontConfig font;
    font.SizePixels = std::max(13.0f, 13.0f * x_scale);
    ImGui::GetIO().Fonts->AddFontDefault(&font);
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);

    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *device.instance();
    info.PhysicalDevice = *device.physical();
    info.Device = *device.handle();
    info.QueueFamily = device.queue_family();
    info.Queue = *device.queue();
    info.DescriptorPool = descriptors;
    info.MinImageCount = info.ImageCount = 2;  // frames of vertices kept: a frame has been drawn before the next begins
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = check;
    ImGui_ImplVulkan_Init(&info, pass);
    gpu::submit_and_wait(device, [](const vk::raii::CommandBuffer& c) { ImGui_ImplVulkan_CreateFontsTexture(*c); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
  }
  ~Context() {
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

Gui::Gui(const Window& window, const gpu::Device& device)
    : window_(window), device_(device), pass_(make_pass(device, window.format())) {
  const vk::DescriptorPoolSize font(vk::DescriptorType::eCombinedImageSampler, 1);
  descriptors_ =
      vk::raii::DescriptorPool(device.handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, font});
  context_ = std::make_unique<Context>(window, device, *pass_, *descriptors_);
}

Gui::~Gui() {
  device_.handle().waitIdle();
}

void Gui::begin([[maybe_unused]] std::span<const int> pressed) {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
#if IMGUI_VERSION_NUM < 18700  // later ones keep a queue of keys
  ImGuiIO& io = ImGui::GetIO();
  const auto set = [&](int key, bool down) {
    if (key < 0 || key >= static_cast<int>(std::size(io.KeysDown))) return;
    io.KeysDown[key] = down;
    if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL) io.KeyCtrl = down;
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) io.KeyShift = down;
  };
  for (const int key : released_) set(key, window_.is_key_down(key));
  released_.clear();
  for (const int key : pressed) {
    set(key, true);
    if (!window_.is_key_down(key)) released_.push_back(key);
  }
#endif
  ImGui::NewFrame();
}

bool Gui::close_lists() {
  if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

void Gui::end() {
  ImGui::Render();
}

void Gui::record(const vk::raii::CommandBuffer& commands, vk::ImageView view, vk::Extent2D size) {
  framebuffer_ = vk::raii::Framebuffer(device_.handle(), {{}, *pass_, view, size.width, size.height, 1});
  commands.beginRenderPass({*pass_, *framebuffer_, {{0, 0}, size}}, vk::SubpassContents::eInline);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), *commands);
  commands.endRenderPass();
}

}  // namespace shadewright::viewer
