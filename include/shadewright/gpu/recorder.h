// Records a frame as named stages and tells afterwards what each of them took.
//
// On a CPU device each stage is a submission of its own, timed by the wall clock (timestamps lie there in frames that
// mix raster and compute); elsewhere the whole frame is one submission with timestamps. Into a caller's command buffer
// nothing is submitted and nothing is timed.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shadewright/gpu/device.h"

namespace shadewright::gpu {

struct StageTime {
  std::string name;
  double milliseconds = 0;
};

class Recorder {
 public:
  /// Owns command buffers and submits them to the device's queue.
  explicit Recorder(const Device& device);
  /// Records into `commands`, which the caller has begun and will submit.
  Recorder(const Device& device, VkCommandBuffer commands);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// True when recording into a caller's command buffer: then `wait` is refused.
  bool embedded() const { return embedded_; }

  /// Records one named stage. All memory written by earlier stages is visible to it.
  void stage(std::string_view name, const std::function<void(const vk::raii::CommandBuffer&)>& record);
  /// Runs one named stage on the CPU, now.
  void cpu_stage(std::string_view name, const std::function<void()>& work);

  /// Submits what is recorded so far and waits for it, so that its results can be read. Logic error when embedded.
  void wait();
  /// Ends the frame: submits, waits, and returns what each stage took, in order (a name may occur more than once).
  std::vector<StageTime> finish();

 private:
  void begin();
  void submit();

  struct Pending {
    size_t stage;
    uint32_t first_query;
  };

  const Device& device_;
  bool embedded_ = false;
  bool recording_ = false;
  vk::raii::CommandPool pool_{nullptr};
  vk::raii::CommandBuffer commands_{nullptr};
  vk::raii::Fence fence_{nullptr};
  vk::raii::QueryPool queries_{nullptr};
  uint32_t query_count_ = 0;
  std::vector<Pending> pending_;
  std::vector<StageTime> times_;
};

}  // namespace shadewright::gpu
