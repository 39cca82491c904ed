#include "shadow/lookup_passes.h"

#include <array>

#include "shadow/lookup_shaders.h"
#include "shadow/receiver_strips.h"
#include "shadow/storage/storage.h"

namespace shadewright::shadow {

namespace {

/// FILTER_PASSES of the filter's GLSL.
uint32_t pass_count(const Spec& spec) {
  if (!storage_traits(spec.storage).in_passes) return 1;
  return spec.filter == "hard" ? 4 : 2;
}

/// Whether the first pass answers several pixels at once: not where the filter's GLSL defines FILTER_LONG.
bool answers_in_words(const Spec& spec) {
  return spec.filter != "aa" && spec.filter != "trilinear";
}

uint32_t words_a_row(vk::Extent2D extent) {
  return static_cast<uint32_t>(shared::answer_words(static_cast<int>(extent.width)));
}

}  // namespace

LookupPasses::LookupPasses(const gpu::Device& device, const Spec& spec, vk::Extent2D extent,
                           vk::DescriptorSetLayout lookup_layout, uint32_t light_kind, Known known)
    : extent_(extent) {
  using enum gpu::BindingKind;
  std::vector kinds{uniform_buffer, sampled_image, sampled_image, storage_image};
  const uint32_t count = pass_count(spec);
  strips_ = receiver_strips(words_a_row(extent) * shared::answers_a_word, extent.height,
                            count > 1 ? most_deferred : gpu::max_binding_bytes);
  const uint64_t rows = strips_.front().rows;
  if (answers_in_words(spec)) {
    answers_ = gpu::Buffer(device, "answers of receivers", words_a_row(extent) * rows * sizeof(uint32_t));
    kinds.push_back(storage_buffer);
  }
  if (count > 1) {
    deferred_ = gpu::Buffer(device, "deferred receivers",
                            shared::max_lookup_passes * sizeof(shared::DeferredReceivers) +
                                (count - 1) * extent.width * rows * sizeof(uint32_t));
    kinds.push_back(storage_buffer);
  }
  const auto shader = lookup_shader(spec.parameterization + "/" + spec.storage + "/" + spec.filter);
  for (uint32_t pass = 0; pass < count; ++pass)
    passes_.push_back(gpu::ComputePass(device, shader, kinds, sizeof(shared::ReceiverStrip),
                                       std::span(&lookup_layout, 1),
                                       {light_kind, pass, known.storage, known.parameterization}));
}

void LookupPasses::record(const vk::raii::CommandBuffer& commands, std::vector<gpu::Binding> receivers,
                          vk::DescriptorSet lookup_set, gpu::Image& visibility) const {
  visibility.transition(commands, vk::ImageLayout::eGeneral, true);
  std::vector<gpu::Binding> bindings = std::move(receivers);
  bindings.push_back(gpu::Binding::storage(visibility.view()));
  for (const gpu::Buffer* buffer : {&answers_, &deferred_})
    if (*buffer) bindings.push_back(gpu::Binding::storage(*buffer));
  for (const shared::ReceiverStrip& strip : strips_) {
    if (strip.first_row > 0) {
      gpu::memory_barrier(commands);  // the buffers' last strip has been answered
      visibility.transition(commands, vk::ImageLayout::eGeneral);
    }
    record_strip(commands, strip, bindings, lookup_set, visibility);
  }
  visibility.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
}

void LookupPasses::record_strip(const vk::raii::CommandBuffer& commands, const shared::ReceiverStrip& strip,
                                std::span<const gpu::Binding> bindings, vk::DescriptorSet lookup_set,
                                gpu::Image& visibility) const {
  const std::span sets(&lookup_set, 1);
  const auto push = gpu::bytes_of(strip);
  if (deferred_) {
    std::array<shared::DeferredReceivers, shared::max_lookup_passes> none;
    none.fill({{0, 1, 1}, 0});
    commands.updateBuffer<shared::DeferredReceivers>(deferred_.handle(), 0, none);
    gpu::memory_barrier(commands);
  }
  const uint32_t a_row = answers_ ? words_a_row(extent_) : extent_.width;
  passes_[0].dispatch(commands, bindings, push, {gpu::groups(a_row, 16), gpu::groups(strip.rows, 4), 1}, sets);
  if (answers_) {
    gpu::memory_barrier(commands);
    visibility.transition(commands, vk::ImageLayout::eTransferDstOptimal);
    const vk::BufferImageCopy region(0, a_row * shared::answers_a_word, 0, {visibility.aspect(), 0, 0, 1},
                                     {0, static_cast<int32_t>(strip.first_row), 0}, {extent_.width, strip.rows, 1});
    commands.copyBufferToImage(answers_.handle(), visibility.handle(), vk::ImageLayout::eTransferDstOptimal, region);
    if (passes_.size() > 1) visibility.transition(commands, vk::ImageLayout::eGeneral);
  }
  for (size_t pass = 1; pass < passes_.size(); ++pass) {
    gpu::memory_barrier(commands);
    passes_[pass].dispatch_indirect(commands, bindings, push, deferred_, pass * sizeof(shared::DeferredReceivers),
                                    sets);
  }
}

std::vector<Allocation> LookupPasses::allocations() const {
  std::vector<Allocation> result;
  for (const gpu::Buffer* buffer : {&answers_, &deferred_})
    if (*buffer) result.push_back(buffer->allocation());
  return result;
}

}  // namespace shadewright::shadow
