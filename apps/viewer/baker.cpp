#include "baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <mutex>

#include "shadewright/error.h"
#include "shadow/lookup_data.h"

namespace shadewright::viewer {

namespace {

constexpr size_t most_kept = 4;
constexpr std::chrono::milliseconds pause(100);  // between two looks at a bake

/// Thrown in the bake's own threads to end it.
struct GivenUp {};

/// Of a scene that does not change, all that tells one bake from another.
std::string name_of(const voxel::BakeOptions& o) {
  return fmt::format("{} {} {} {} {} {}", o.resolution, o.depth_voxels.value_or(0), static_cast<int>(o.closed),
                     o.static_receivers, o.max_filter, o.pyramid);
}

/// Where a bake is, told by its threads and read by the window's.
class Place {
 public:
  void set(std::string_view task, double fraction) {
    const std::lock_guard lock(mutex_);
    task_ = task;
    fraction_ = fraction;
  }
  std::pair<std::string, double> get() const {
    const std::lock_guard lock(mutex_);
    return {task_, fraction_};
  }

 private:
  mutable std::mutex mutex_;
  std::string task_;
  double fraction_ = 0;
};

}  // namespace

voxel::VoxelShadow Baker::operator()(const Scene& scene, const Light& light, const voxel::BakeOptions& options) {
  const std::string what = name_of(options);
  const auto kept =
      std::ranges::find_if(kept_, [&](const Baked& b) { return b.what == what && shadow::same_light(b.light, light); });
  if (kept != kept_.end()) return kept->shadow;

  Place place;
  std::atomic<bool> given_up = false;
  const auto progress = [&](std::string_view task, double fraction) {
    place.set(task, fraction);
    if (given_up) throw GivenUp{};
  };
  std::future<voxel::VoxelShadow> bake =
      std::async(std::launch::async, [&] { return voxel::bake(scene, light, options, progress).shadow; });
  try {
    while (bake.wait_for(pause) != std::future_status::ready) {
      const auto [task, fraction] = place.get();
      given_up = given_up || !watch_("bake: " + task, fraction);
    }
    kept_.push_front({what, light, bake.get()});
  } catch (const GivenUp&) {
    throw FailureError("bake", "it was given up", "change the spec or the light to try again");
  } catch (...) {
    given_up = true;
    if (bake.valid()) bake.wait();
    throw;
  }
  if (kept_.size() > most_kept) kept_.pop_back();
  return kept_.front().shadow;
}

}  // namespace shadewright::viewer
