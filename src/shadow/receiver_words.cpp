#include "shadow/receiver_words.h"

#include <cstring>

namespace shadewright::shadow {

std::vector<uint32_t> receiver_words(const gpu::Device& device, std::span<const uint32_t> spirv,
                                     const ReceiverLookup& lookup) {
  using enum gpu::BindingKind;
  const gpu::ComputePass pass(device, spirv, {uniform_buffer, sampled_image, sampled_image, storage_buffer}, 0,
                              std::span(&lookup.layout, 1), {lookup.light_kind});
  std::vector<uint32_t> words(size_t{lookup.width} * lookup.height);
  const uint64_t bytes = words.size() * sizeof(uint32_t);
  const gpu::Buffer answers(device, "answers of receivers", bytes);
  gpu::submit_and_wait(device, [&](const vk::raii::CommandBuffer& commands) {
    auto bindings = lookup.receivers;
    bindings.push_back(gpu::Binding::storage(answers));
    pass.dispatch(commands, bindings, {}, {gpu::groups(lookup.width, 8), gpu::groups(lookup.height, 8), 1},
                  std::span(&lookup.set, 1));
  });
  std::memcpy(words.data(), gpu::read_back(device, answers, bytes).data(), bytes);
  return words;
}

}  // namespace shadewright::shadow
