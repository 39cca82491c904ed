#include "shadow/receiver_words.h"

#include <cstring>

#include "shadow/receiver_strips.h"

namespace shadewright::shadow {

std::vector<std::vector<std::byte>> receiver_answers(const gpu::Device& device, std::span<const uint32_t> spirv,
                                                     const ReceiverLookup& lookup, uint32_t outputs, uint32_t bytes) {
  using enum gpu::BindingKind;
  std::vector kinds{uniform_buffer, sampled_image, sampled_image};
  kinds.resize(kinds.size() + outputs, storage_buffer);
  const gpu::ComputePass pass(device, spirv, kinds, sizeof(shared::ReceiverStrip), std::span(&lookup.layout, 1),
                              {lookup.light_kind});
  const auto strips = receiver_strips(lookup.width, lookup.height, gpu::max_binding_bytes / bytes);
  const uint64_t row_bytes = uint64_t{lookup.width} * bytes;
  std::vector<gpu::Buffer> buffers;
  std::vector<gpu::Binding> bindings = lookup.receivers;
  for (uint32_t i = 0; i < outputs; ++i)
    buffers.emplace_back(device, "answers of receivers", row_bytes * strips[0].rows);
  for (const gpu::Buffer& buffer : buffers) bindings.push_back(gpu::Binding::storage(buffer));
  std::vector answers(outputs, std::vector<std::byte>(row_bytes * lookup.height));
  for (const shared::ReceiverStrip& strip : strips) {
    gpu::submit_and_wait(device, [&](const vk::raii::CommandBuffer& commands) {
      pass.dispatch(commands, bindings, gpu::bytes_of(strip),
                    {gpu::groups(lookup.width, 8), gpu::groups(strip.rows, 8), 1}, std::span(&lookup.set, 1));
    });
    for (uint32_t i = 0; i < outputs; ++i) {
      const auto part = gpu::read_back(device, buffers[i], row_bytes * strip.rows);
      std::memcpy(&answers[i][row_bytes * strip.first_row], part.data(), part.size());
    }
  }
  return answers;
}

std::vector<uint32_t> receiver_words(const gpu::Device& device, std::span<const uint32_t> spirv,
                                     const ReceiverLookup& lookup) {
  const std::vector<std::byte> bytes = receiver_answers(device, spirv, lookup, 1, sizeof(uint32_t)).front();
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

}  // namespace shadewright::shadow
