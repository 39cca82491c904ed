#include "gpu/compaction.h"

#include <array>

#include "shaders/compact_flags_comp.h"
#include "shaders/compact_scatter_comp.h"
#include "shaders/mark_repeats_comp.h"

namespace shadewright::gpu {

Compaction::Compaction(const Device& device, uint32_t max_count)
    : scan_(device, max_count),
      places_(device, "compaction places", uint64_t{max_count} * sizeof(uint32_t)),
      marked_(device, "compaction marks", uint64_t{max_count} * sizeof(uint32_t)) {
  using enum BindingKind;
  flags_ = ComputePass(device, shaders::compact_flags_comp, {storage_buffer, storage_buffer}, sizeof(uint32_t));
  scatter_ = ComputePass(device, shaders::compact_scatter_comp, {storage_buffer, storage_buffer, storage_buffer},
                         sizeof(uint32_t));
  mark_repeats_ = ComputePass(device, shaders::mark_repeats_comp, {storage_buffer, storage_buffer}, sizeof(uint32_t));
}

void Compaction::record(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count,
                        const Buffer& compact) const {
  const Binding in = Binding::storage(values), places = Binding::storage(places_);
  const vk::Extent3D size{groups(count, 256), 1, 1};
  if (count > 0) flags_.dispatch(commands, std::array{in, places}, bytes_of(count), size);
  memory_barrier(commands);
  scan_.record(commands, places_, count);
  memory_barrier(commands);
  if (count > 0) scatter_.dispatch(commands, std::array{in, places, Binding::storage(compact)}, bytes_of(count), size);
}

void Compaction::record_unique(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count,
                               const Buffer& compact) const {
  if (count > 0)
    mark_repeats_.dispatch(commands, std::array{Binding::storage(values), Binding::storage(marked_)}, bytes_of(count),
                           {groups(count, 256), 1, 1});
  memory_barrier(commands);
  record(commands, marked_, count, compact);
}

std::vector<Allocation> Compaction::allocations() const {
  return {scan_.totals().allocation(), places_.allocation(), marked_.allocation()};
}

}  // namespace shadewright::gpu
