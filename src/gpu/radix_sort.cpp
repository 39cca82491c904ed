#include "gpu/radix_sort.h"

#include <array>

#include "shaders/radix_count_comp.h"
#include "shaders/radix_scatter_comp.h"

namespace shadewright::gpu {

namespace {

constexpr uint32_t block = 1024, digits = 16, digit_bits = 4;

}  // namespace

RadixSort::RadixSort(const Device& device, uint32_t max_count)
    : scan_(device, digits * groups(max_count, block)),
      counts_(device, "sort counts", uint64_t{digits} * groups(max_count, block) * sizeof(uint32_t)),
      other_(device, "sort keys", uint64_t{max_count} * sizeof(uint32_t)) {
  using enum BindingKind;
  count_ = ComputePass(device, shaders::radix_count_comp, {storage_buffer, storage_buffer}, 2 * sizeof(uint32_t));
  scatter_ = ComputePass(device, shaders::radix_scatter_comp, {storage_buffer, storage_buffer, storage_buffer},
                         2 * sizeof(uint32_t));
}

void RadixSort::record(const vk::raii::CommandBuffer& commands, const Buffer& keys, uint32_t count,
                       uint32_t bits) const {
  if (count < 2) return;
  const uint32_t blocks = groups(count, block);
  const Buffer *from = &keys, *to = &other_;
  for (uint32_t shift = 0; shift < bits; shift += digit_bits) {
    const std::array push{count, shift};
    count_.dispatch(commands, std::array{Binding::storage(*from), Binding::storage(counts_)}, bytes_of(push),
                    {blocks, 1, 1});
    memory_barrier(commands);
    scan_.record(commands, counts_, digits * blocks);
    memory_barrier(commands);
    scatter_.dispatch(commands, std::array{Binding::storage(*from), Binding::storage(counts_), Binding::storage(*to)},
                      bytes_of(push), {blocks, 1, 1});
    memory_barrier(commands);
    std::swap(from, to);
  }
  if (from != &keys)
    commands.copyBuffer(other_.handle(), keys.handle(), vk::BufferCopy(0, 0, uint64_t{count} * sizeof(uint32_t)));
}

std::vector<Allocation> RadixSort::allocations() const {
  return {scan_.totals().allocation(), counts_.allocation(), other_.allocation()};
}

}  // namespace shadewright::gpu
