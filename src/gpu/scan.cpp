#include "gpu/scan.h"

#include "shaders/scan_add_comp.h"
#include "shaders/scan_blocks_comp.h"
#include "shaders/scan_totals_comp.h"

namespace shadewright::gpu {

Scan::Scan(const Device& device, uint32_t max_count)
    : totals_(device, "scan totals", (groups(max_count, 1024) + 1) * sizeof(uint32_t)) {
  using enum BindingKind;
  blocks_ = ComputePass(device, shaders::scan_blocks_comp, {storage_buffer, storage_buffer}, sizeof(uint32_t));
  block_totals_ = ComputePass(device, shaders::scan_totals_comp, {storage_buffer}, sizeof(uint32_t));
  add_ = ComputePass(device, shaders::scan_add_comp, {storage_buffer, storage_buffer}, sizeof(uint32_t));
}

void Scan::record(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count) const {
  const Binding both[] = {Binding::storage(values), Binding::storage(totals_)};
  const Binding totals[] = {Binding::storage(totals_)};
  const uint32_t blocks = groups(count, 1024);
  const auto push = bytes_of(count);
  if (blocks > 0) blocks_.dispatch(commands, both, push, {blocks, 1, 1});
  memory_barrier(commands);
  block_totals_.dispatch(commands, totals, push, {1, 1, 1});
  memory_barrier(commands);
  if (blocks > 1) add_.dispatch(commands, both, push, {blocks, 1, 1});
}

}  // namespace shadewright::gpu
