#include "shadow/parameterization/paged/request_list.h"

#include <array>
#include <bit>

#include "shaders/page_components_comp.h"
#include "shaders/page_list_comp.h"
#include "shaders/page_mark_comp.h"

namespace shadewright::shadow {

namespace {

struct ComponentsPush {
  glm::uvec2 size;
  uint32_t levels;
  uint32_t row_of_groups;
};

}  // namespace

RequestList::RequestList(const gpu::Device& device, uint32_t width, uint32_t height, uint32_t levels, uint32_t pages,
                         vk::DescriptorSetLayout lookup_layout, bool six_faces)
    : size_(width, height),
      levels_(levels),
      key_bits_(static_cast<uint32_t>(std::bit_width(pages))),
      capacity_(levels * width * height + width * height / 4),
      compaction_(device, capacity_),
      sort_(device, capacity_),
      requests_(device, "page request list", uint64_t{capacity_} * sizeof(uint32_t)),
      kept_(device, "kept page requests", uint64_t{capacity_} * sizeof(uint32_t)),
      count_(device, "page request count", sizeof(uint32_t), gpu::HostAccess::read) {
  using enum gpu::BindingKind;
  list_pass_ = gpu::ComputePass(
      device, shaders::page_list_comp,
      {uniform_buffer, sampled_image, sampled_image, storage_buffer, storage_buffer, storage_buffer, storage_buffer}, 0,
      std::span(&lookup_layout, 1), six_faces);
  components_pass_ =
      gpu::ComputePass(device, shaders::page_components_comp, {storage_buffer, storage_buffer}, sizeof(ComponentsPush));
  mark_pass_ = gpu::ComputePass(device, shaders::page_mark_comp,
                                {uniform_buffer, storage_buffer, storage_buffer, storage_buffer}, sizeof(uint32_t));
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
  using gpu::Binding;
  recorder.stage("page requests", [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(requests_.handle(), 0, VK_WHOLE_SIZE, ~0u);
    gpu::memory_barrier(commands);
    std::vector<Binding> all(lookup.receivers.begin(), lookup.receivers.end());
    for (const gpu::Buffer* buffer : {&masks.requested, &masks.requested_or_finer, &masks.state})
      all.push_back(Binding::storage(*buffer));
    all.push_back(Binding::storage(requests_));
    list_pass_.dispatch(commands, all, {}, {gpu::groups(size_.x, 8), gpu::groups(size_.y, 8), 1},
                        std::span(&lookup.set, 1));
  });
  recorder.stage("connected components", [&](const vk::raii::CommandBuffer& commands) {
    const uint32_t groups = gpu::groups(capacity_, 64), row = 32768;
    const ComponentsPush push{size_, levels_, row};
    components_pass_.dispatch(commands, std::array{Binding::storage(requests_), Binding::storage(kept_)},
                              gpu::bytes_of(push), {std::min(groups, row), gpu::groups(groups, row), 1});
  });
  compacted_ = read_count([&](const auto& commands) { compaction_.record(commands, kept_, capacity_, requests_); },
                          capacity_, "compaction", recorder);
  recorder.stage("sort", [&](const vk::raii::CommandBuffer& commands) {
    sort_.record(commands, requests_, compacted_, key_bits_);
  });
  unique_ = read_count([&](const auto& commands) { compaction_.record_unique(commands, requests_, compacted_, kept_); },
                       compacted_, "unique requests", recorder);
}

void RequestList::mark(const vk::raii::CommandBuffer& commands, const gpu::Buffer& constants,
                       const RequestMasks& masks) const {
  using gpu::Binding;
  if (unique_ == 0) return;
  mark_pass_.dispatch(commands,
                      std::array{Binding::uniform(constants), Binding::storage(kept_),
                                 Binding::storage(masks.requested), Binding::storage(masks.requested_or_finer)},
                      gpu::bytes_of(unique_), {gpu::groups(unique_, 64), 1, 1});
}

std::vector<Allocation> RequestList::allocations() const {
  std::vector<Allocation> result{requests_.allocation(), kept_.allocation(), count_.allocation()};
  for (Allocation& allocation : compaction_.allocations()) result.push_back(std::move(allocation));
  for (Allocation& allocation : sort_.allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
