#include "shadewright/gpu/resources.h"

#include <fmt/format.h>

#include <functional>

#include "shadewright/error.h"

namespace shadewright::gpu {

namespace {

vk::raii::DeviceMemory allocate(const Device& device, const std::string& name, const vk::MemoryRequirements& needs,
                                vk::MemoryPropertyFlags wanted, vk::MemoryAllocateFlags flags = {}) {
  try {
    const vk::MemoryAllocateFlagsInfo flags_info(flags);
    vk::MemoryAllocateInfo info(needs.size, device.memory_type(needs.memoryTypeBits, wanted));
    if (flags) info.pNext = &flags_info;
    return vk::raii::DeviceMemory(device.handle(), info);
  } catch (const vk::OutOfDeviceMemoryError&) {
  } catch (const vk::OutOfHostMemoryError&) {
  }
  throw FailureError(device.info().name, fmt::format("out of memory for '{}' ({} MB)", name, needs.size >> 20),
                     "use a smaller resolution or scene");
}

vk::ImageAspectFlags aspect_of(vk::Format format) {
  return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

}  // namespace

Buffer::Buffer(const Device& device, std::string name, uint64_t bytes, HostAccess access)
    : name_(std::move(name)), size_((std::max<uint64_t>(bytes, 16) + 15) & ~uint64_t{15}) {
  using Usage = vk::BufferUsageFlagBits;
  const auto usage = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst | Usage::eVertexBuffer |
                     Usage::eIndexBuffer | Usage::eIndirectBuffer | Usage::eUniformBuffer | Usage::eShaderDeviceAddress;
  buffer_ = vk::raii::Buffer(device.handle(), {{}, size_, usage, vk::SharingMode::eExclusive});
  using Property = vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags wanted = access == HostAccess::none ? vk::MemoryPropertyFlags(Property::eDeviceLocal)
                                                                    : Property::eHostVisible | Property::eHostCoherent;
  memory_ =
      allocate(device, name_, buffer_.getMemoryRequirements(), wanted, vk::MemoryAllocateFlagBits::eDeviceAddress);
  buffer_.bindMemory(*memory_, 0);
  if (access != HostAccess::none) mapped_ = memory_.mapMemory(0, VK_WHOLE_SIZE);
}

uint64_t Buffer::device_address(const Device& device) const {
  return device.handle().getBufferAddress({*buffer_});
}

Image::Image(const Device& device, const ImageDesc& desc) : desc_(desc), aspect_(aspect_of(desc.format)) {
  const uint32_t limit = device.physical().getProperties().limits.maxImageDimension2D;
  if (desc.width > limit || desc.height > limit)
    throw InputError(fmt::format("{} {}x{}", desc.name, desc.width, desc.height),
                     fmt::format("{} makes images of at most {}x{}", device.info().name, limit, limit), "ask for less");
  vk::ImageCreateInfo info({}, vk::ImageType::e2D, desc.format, {desc.width, desc.height, 1}, 1, desc.layers);
  info.usage = desc.usage;
  image_ = vk::raii::Image(device.handle(), info);
  const auto needs = image_.getMemoryRequirements();
  bytes_ = needs.size;
  memory_ = allocate(device, desc.name, needs, vk::MemoryPropertyFlagBits::eDeviceLocal);
  image_.bindMemory(*memory_, 0);
  using Usage = vk::ImageUsageFlagBits;
  if (!(desc.usage & (Usage::eSampled | Usage::eStorage | Usage::eColorAttachment | Usage::eDepthStencilAttachment)))
    return;
  const bool array = desc.layers > 1 || desc.array_view;
  view_ = vk::raii::ImageView(device.handle(), {{},
                                                *image_,
                                                array ? vk::ImageViewType::e2DArray : vk::ImageViewType::e2D,
                                                desc.format,
                                                {},
                                                {aspect_, 0, 1, 0, desc.layers}});
  for (uint32_t layer = 0; layer < desc.layers; ++layer)
    layer_views_.emplace_back(device.handle(), vk::ImageViewCreateInfo({}, *image_, vk::ImageViewType::e2D, desc.format,
                                                                       {}, {aspect_, 0, 1, layer, 1}));
}

void Image::transition(const vk::raii::CommandBuffer& commands, vk::ImageLayout layout, bool discard) {
  const vk::ImageMemoryBarrier2 barrier(
      vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
      vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
      discard ? vk::ImageLayout::eUndefined : layout_, layout, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
      *image_, {aspect_, 0, 1, 0, desc_.layers});
  commands.pipelineBarrier2({{}, {}, {}, barrier});
  layout_ = layout;
}

void memory_barrier(const vk::raii::CommandBuffer& commands) {
  const vk::MemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                   vk::PipelineStageFlagBits2::eAllCommands,
                                   vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite);
  commands.pipelineBarrier2({{}, barrier});
}

void submit_and_wait(const Device& device, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  const vk::raii::CommandPool pool(device.handle(), {vk::CommandPoolCreateFlagBits::eTransient, device.queue_family()});
  const vk::raii::CommandBuffers buffers(device.handle(), {*pool, vk::CommandBufferLevel::ePrimary, 1});
  const auto& commands = buffers.front();
  commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(commands);
  memory_barrier(commands);
  commands.end();
  const vk::raii::Fence fence(device.handle(), vk::FenceCreateInfo{});
  device.queue().submit(vk::SubmitInfo({}, {}, *commands), *fence);
  if (device.handle().waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
    throw FailureError(device.info().name, "the device did not finish its work");
}

void upload(const Device& device, const Buffer& buffer, std::span<const std::byte> data) {
  // In pieces, so that a large scene does not need its size twice.
  constexpr size_t piece = 64u << 20;
  const Buffer staging(device, "staging", std::min(piece, data.size()), HostAccess::write);
  for (size_t offset = 0; offset < data.size(); offset += piece) {
    const size_t bytes = std::min(piece, data.size() - offset);
    std::memcpy(staging.mapped<std::byte>().data(), data.data() + offset, bytes);
    submit_and_wait(device, [&](const auto& commands) {
      commands.copyBuffer(staging.handle(), buffer.handle(), vk::BufferCopy(0, offset, bytes));
    });
  }
}

void upload(const Device& device, Image& image, std::span<const std::byte> data) {
  const Buffer staging(device, "staging", data.size(), HostAccess::write);
  std::memcpy(staging.mapped<std::byte>().data(), data.data(), data.size());
  submit_and_wait(device, [&](const auto& commands) {
    image.transition(commands, vk::ImageLayout::eTransferDstOptimal, true);
    const vk::BufferImageCopy region(0, 0, 0, {image.aspect(), 0, 0, 1}, {},
                                     {image.desc().width, image.desc().height, 1});
    commands.copyBufferToImage(staging.handle(), image.handle(), vk::ImageLayout::eTransferDstOptimal, region);
    image.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
}

std::vector<std::byte> read_back(const Device& device, const Buffer& buffer, uint64_t bytes) {
  const Buffer staging(device, "staging", bytes, HostAccess::read);
  submit_and_wait(device, [&](const auto& commands) {
    memory_barrier(commands);
    commands.copyBuffer(buffer.handle(), staging.handle(), vk::BufferCopy(0, 0, bytes));
  });
  const auto mapped = staging.mapped<std::byte>().first(bytes);
  return {mapped.begin(), mapped.end()};
}

std::vector<std::byte> read_back(const Device& device, Image& image, uint32_t bytes_per_pixel, uint32_t layer) {
  const uint64_t bytes = uint64_t{image.desc().width} * image.desc().height * bytes_per_pixel;
  const Buffer staging(device, "staging", bytes, HostAccess::read);
  submit_and_wait(device, [&](const auto& commands) {
    image.transition(commands, vk::ImageLayout::eTransferSrcOptimal);
    const vk::BufferImageCopy region(0, 0, 0, {image.aspect(), 0, layer, 1}, {},
                                     {image.desc().width, image.desc().height, 1});
    commands.copyImageToBuffer(image.handle(), vk::ImageLayout::eTransferSrcOptimal, staging.handle(), region);
  });
  const auto mapped = staging.mapped<std::byte>().first(bytes);
  return {mapped.begin(), mapped.end()};
}

}  // namespace shadewright::gpu
