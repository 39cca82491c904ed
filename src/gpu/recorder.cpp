#include "shadewright/gpu/recorder.h"

#include <stdexcept>

#include "shadewright/error.h"
#include "shadewright/gpu/resources.h"

namespace shadewright::gpu {

namespace {

constexpr uint32_t max_queries = 256;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Recorder::Recorder(const Device& device)
    : device_(device),
      pool_(device.handle(), {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queue_family()}),
      fence_(device.handle(), vk::FenceCreateInfo{}) {
  vk::raii::CommandBuffers buffers(device.handle(), {*pool_, vk::CommandBufferLevel::ePrimary, 1});
  commands_ = std::move(buffers.front());
  if (!device.is_cpu()) queries_ = vk::raii::QueryPool(device.handle(), {{}, vk::QueryType::eTimestamp, max_queries});
}

Recorder::Recorder(const Device& device, VkCommandBuffer commands)
    : device_(device), embedded_(true), commands_(device.handle(), commands, VK_NULL_HANDLE) {}

Recorder::~Recorder() {
  if (embedded_) commands_.release();
}

void Recorder::begin() {
  if (recording_) return;
  commands_.reset();
  commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  if (!device_.is_cpu()) commands_.resetQueryPool(*queries_, 0, max_queries);
  query_count_ = 0;
  recording_ = true;
}

void Recorder::submit() {
  if (!recording_) return;
  commands_.end();
  recording_ = false;
  device_.handle().resetFences(*fence_);
  try {
    device_.queue().submit(vk::SubmitInfo({}, {}, *commands_), *fence_);
    if (device_.handle().waitForFences(*fence_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
      throw FailureError(device_.info().name, "the device did not finish its work");
  } catch (const vk::DeviceLostError&) {
    throw FailureError(device_.info().name, "the device was lost",
                       "try again, with a smaller resolution or another --device");
  }
  for (const Pending& pending : pending_) {
    const auto ticks = queries_.getResults<uint64_t>(pending.first_query, 2, 2 * sizeof(uint64_t), sizeof(uint64_t),
                                                     vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    times_[pending.stage].milliseconds =
        static_cast<double>(ticks.second[1] - ticks.second[0]) * device_.nanoseconds_per_tick() * 1e-6;
  }
  pending_.clear();
}

void Recorder::stage(std::string_view name, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  if (embedded_) {
    record(commands_);
    memory_barrier(commands_);
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  if (query_count_ + 2 > max_queries) submit();
  begin();
  times_.push_back({std::string(name), 0});
  if (device_.is_cpu()) {
    record(commands_);
    memory_barrier(commands_);
    submit();
    times_.back().milliseconds = milliseconds_since(start);
    return;
  }
  commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, query_count_);
  record(commands_);
  memory_barrier(commands_);
  commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries_, query_count_ + 1);
  pending_.push_back({times_.size() - 1, query_count_});
  query_count_ += 2;
}

void Recorder::cpu_stage(std::string_view name, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  times_.push_back({std::string(name), milliseconds_since(start)});
}

void Recorder::wait() {
  if (embedded_) throw std::logic_error("a recorder of the caller's command buffer can't wait");
  submit();
}

std::vector<StageTime> Recorder::finish() {
  if (!embedded_) submit();
  return std::move(times_);
}

}  // namespace shadewright::gpu
