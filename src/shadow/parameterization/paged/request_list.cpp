#include "shadow/parameterization/paged/request_list.h"

#include <array>
#include <bit>

#include "shaders/page_components_comp.h"
#include "shaders/page_edge_list_comp.h"
#include "shaders/page_list_comp.h"
#include "shaders/page_mark_comp.h"

namespace shadewright::shadow {

namespace {

constexpr uint32_t row_of_groups = 32768;  // of a dispatch in two dimensions, since one may be too short

struct ComponentsPush {
  glm::uvec2 size;
  uint32_t levels;
  uint32_t row_of_groups;
};

struct MarkPush {
  uint32_t count;
  uint32_t row_of_groups;
};

vk::Extent3D groups_of(uint32_t count) {
  const uint32_t groups = gpu::groups(count, 64);
  return {std::min(groups, row_of_groups), gpu::groups(groups, row_of_groups), 1};
}

/// Room in the list: of full words of the buffer, whose length the shaders ask for.
uint64_t capacity(uint64_t width, uint64_t height, uint64_t levels) {
  return (levels * width * height + width * height / 4 + 3) / 4 * 4;
}

}  // namespace

bool RequestList::serves(uint32_t width, uint32_t height, uint32_t levels) {
  return capacity(width, height, levels) * sizeof(uint32_t) <= gpu::max_binding_bytes;
}

RequestList::RequestList(const gpu::Device& device, const RequestListDesc& desc)
    : desc_(desc),
      capacity_(static_cast<uint32_t>(capacity(desc.width, desc.height, desc.levels))),
      requests_(device, "page request list", uint64_t{capacity_} * sizeof(uint32_t)) {
  using enum gpu::BindingKind;
  const std::span<const uint32_t> list = desc.edges ? std::span<const uint32_t>(shaders::page_edge_list_comp)
                                                    : std::span<const uint32_t>(shaders::page_list_comp);
  list_pass_ = gpu::ComputePass(
      device, list,
      {uniform_buffer, sampled_image, sampled_image, storage_buffer, storage_buffer, storage_buffer, storage_buffer}, 0,
      std::span(&desc.lookup_layout, 1), {desc.light_kind});
  mark_pass_ = gpu::ComputePass(device, shaders::page_mark_comp,
                                {uniform_buffer, storage_buffer, storage_buffer, storage_buffer}, sizeof(MarkPush));
  if (desc.uniquify >= Uniquify::components) {
    kept_ = gpu::Buffer(device, "kept page requests", uint64_t{capacity_} * sizeof(uint32_t));
    components_pass_ = gpu::ComputePass(device, shaders::page_components_comp, {storage_buffer, storage_buffer},
                                        sizeof(ComponentsPush));
  }
  if (desc.uniquify >= Uniquify::compact) {
    compaction_ = gpu::Compaction(device, capacity_);
    count_ = gpu::Buffer(device, "page request count", sizeof(uint32_t), gpu::HostAccess::read);
  }
  if (desc.uniquify == Uniquify::full) sort_ = gpu::RadixSort(device, capacity_);
  if (desc.on_host) {
    on_host_ =
        gpu::Buffer(device, "page requests on the host", uint64_t{capacity_} * sizeof(uint32_t), gpu::HostAccess::read);
    seen_.assign(desc.pages / 32, 0);
  }
}

uint32_t RequestList::read_count(const std::function<void(const vk::raii::CommandBuffer&)>& compact, uint32_t of,
                                 const char* stage, gpu::Recorder& recorder) const {
  recorder.stage(stage, [&](const vk::raii::CommandBuffer& commands) {
    compact(commands);
    gpu::memory_barrier(commands);
    const vk::BufferCopy total(gpu::Scan::total_index(of) * sizeof(uint32_t), 0, sizeof(uint32_t));
    commands.copyBuffer(compaction_.scan().totals().handle(), count_.handle(), total);
  });
  recorder.wait();
  return count_.mapped<uint32_t>()[0];
}

void RequestList::find(const ReceiverLookup& lookup, const RequestMasks& masks, gpu::Recorder& recorder) {
  list(lookup, masks, recorder);
  thin(recorder);
  if (desc_.on_host) make_unique_on_host(recorder);
}

void RequestList::list(const ReceiverLookup& lookup, const RequestMasks& masks, gpu::Recorder& recorder) const {
  using gpu::Binding;
  recorder.stage("page requests", [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(requests_.handle(), 0, VK_WHOLE_SIZE, ~0u);
    gpu::memory_barrier(commands);
    std::vector<Binding> all(lookup.receivers.begin(), lookup.receivers.end());
    for (const gpu::Buffer* buffer : {&masks.requested, &masks.requested_or_finer, &masks.state})
      all.push_back(Binding::storage(*buffer));
    all.push_back(Binding::storage(requests_));
    list_pass_.dispatch(commands, all, {}, {gpu::groups(desc_.width, 8), gpu::groups(desc_.height, 8), 1},
                        std::span(&lookup.set, 1));
  });
}

const gpu::Buffer& RequestList::thinned() const {
  return desc_.uniquify == Uniquify::none || desc_.uniquify == Uniquify::compact ? requests_ : kept_;
}

void RequestList::thin(gpu::Recorder& recorder) {
  using gpu::Binding;
  counts_ = {capacity_, 0, 0};
  if (desc_.uniquify < Uniquify::components) return;
  recorder.stage("connected components", [&](const vk::raii::CommandBuffer& commands) {
    const ComponentsPush push{{desc_.width, desc_.height}, desc_.levels, row_of_groups};
    components_pass_.dispatch(commands, std::array{Binding::storage(requests_), Binding::storage(kept_)},
                              gpu::bytes_of(push), groups_of(capacity_));
  });
  if (desc_.uniquify < Uniquify::compact) return;
  counts_.compacted =
      read_count([&](const auto& commands) { compaction_.record(commands, kept_, capacity_, requests_); }, capacity_,
                 "compaction", recorder);
  counts_.listed = counts_.compacted;
  if (desc_.uniquify < Uniquify::full) return;
  recorder.stage("sort", [&](const vk::raii::CommandBuffer& commands) {
    sort_.record(commands, requests_, counts_.compacted, static_cast<uint32_t>(std::bit_width(desc_.pages)));
  });
  counts_.unique = read_count(
      [&](const auto& commands) { compaction_.record_unique(commands, requests_, counts_.compacted, kept_); },
      counts_.compacted, "unique requests", recorder);
  counts_.listed = counts_.unique;
}

void RequestList::make_unique_on_host(gpu::Recorder& recorder) {
  if (counts_.listed > 0)
    recorder.stage("requests to the host", [&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(thinned().handle(), on_host_.handle(),
                          vk::BufferCopy(0, 0, uint64_t{counts_.listed} * sizeof(uint32_t)));
    });
  recorder.wait();
  recorder.cpu_stage("requests on the host", [&] {
    std::fill(seen_.begin(), seen_.end(), 0u);
    const std::span<uint32_t> list = on_host_.mapped<uint32_t>();
    uint32_t unique = 0;
    for (uint32_t i = 0; i < counts_.listed; ++i) {
      const uint32_t page = list[i];
      if (page == ~0u) continue;
      uint32_t& word = seen_[page / 32];
      const uint32_t bit = 1u << page % 32;
      if ((word & bit) != 0) continue;
      word |= bit;
      list[unique++] = page;
    }
    counts_.unique = unique;
  });
}

void RequestList::mark(const vk::raii::CommandBuffer& commands, const gpu::Buffer& constants,
                       const RequestMasks& masks) const {
  using gpu::Binding;
  const uint32_t count = desc_.on_host ? counts_.unique : counts_.listed;
  const gpu::Buffer& pages = desc_.on_host ? on_host_ : thinned();
  if (count == 0) return;
  mark_pass_.dispatch(commands,
                      std::array{Binding::uniform(constants), Binding::storage(pages),
                                 Binding::storage(masks.requested), Binding::storage(masks.requested_or_finer)},
                      gpu::bytes_of(MarkPush{count, row_of_groups}), groups_of(count));
}

std::vector<Allocation> RequestList::allocations() const {
  std::vector<Allocation> result;
  for (const gpu::Buffer* buffer : {&requests_, &kept_, &count_, &on_host_})
    if (*buffer) result.push_back(buffer->allocation());
  if (desc_.uniquify >= Uniquify::compact)
    for (Allocation& allocation : compaction_.allocations()) result.push_back(std::move(allocation));
  if (desc_.uniquify == Uniquify::full)
    for (Allocation& allocation : sort_.allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
