#include "shadow/decisions.h"

#include <array>

#include "shadow/lookup_shaders.h"
#include "shadow/receiver_words.h"
#include "shadow/storage/subpixel/shared.h"

namespace shadewright::shadow {

Decisions::Decisions(const gpu::Device& device, std::vector<std::string> names, uint32_t frames_in_flight)
    : names_(std::move(names)),
      counts_(device, "decisions", shared::decision_banks * shared::decision_bank_words * sizeof(uint32_t)) {
  for (uint32_t slot = 0; slot < frames_in_flight; ++slot)
    read_.emplace_back(device, "decisions", counts_.size(), gpu::HostAccess::read);
}

void Decisions::clear(const vk::raii::CommandBuffer& commands) const {
  commands.fillBuffer(counts_.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::memory_barrier(commands);
}

void Decisions::take(const vk::raii::CommandBuffer& commands, uint32_t slot) {
  gpu::memory_barrier(commands);
  commands.copyBuffer(counts_.handle(), read_[slot].handle(), vk::BufferCopy(0, 0, counts_.size()));
  gpu::memory_barrier(commands);
  last_slot_ = slot;
}

Counters Decisions::counters() const {
  Counters counters;
  const auto counts = read_[last_slot_].mapped<uint32_t>();
  for (size_t i = 0; i < names_.size(); ++i) {
    uint64_t sum = 0;
    for (size_t bank = 0; bank < shared::decision_banks; ++bank) sum += counts[bank * shared::decision_bank_words + i];
    counters[names_[i]] = {static_cast<double>(sum)};
  }
  return counters;
}

std::vector<Allocation> Decisions::allocations() const {
  std::vector<Allocation> result{counts_.allocation()};
  for (const gpu::Buffer& buffer : read_) result.push_back(buffer.allocation());
  return result;
}

Picture decisions_picture(const gpu::Device& device, std::string_view maps, const ReceiverLookup& lookup,
                          bool six_faces) {
  constexpr std::array<glm::u8vec4, 4> shadowed{
      {{20, 20, 20, 255}, {70, 70, 70, 255}, {20, 110, 30, 255}, {150, 20, 20, 255}}};
  constexpr std::array<glm::u8vec4, 4> lit{
      {{20, 20, 20, 255}, {200, 200, 200, 255}, {110, 220, 120, 255}, {255, 110, 100, 255}}};
  Picture picture{lookup.width, lookup.height, {}};
  for (const uint32_t decision : receiver_words(device, decisions_shader(maps), lookup, six_faces))
    picture.pixels.push_back(decision >= shared::decided_lit ? lit[decision - shared::decided_lit]
                                                             : shadowed[decision]);
  return picture;
}

}  // namespace shadewright::shadow
