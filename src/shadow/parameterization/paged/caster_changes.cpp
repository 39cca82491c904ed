#include "shadow/parameterization/paged/caster_changes.h"

#include <algorithm>

#include "shadow/lookup_data.h"

namespace shadewright::shadow {

void CasterChanges::find(const Frame& frame) {
  const uint64_t updates = frame.scene ? frame.scene->update_count() : 0;
  all_ = !known_ || scene_ != KnownScene(frame.scene) || casters_ != frame.casters ||
         !same_light(light_, frame.light) || updates > updates_ + 1;
  boxes_.clear();
  if (!all_ && updates > updates_)
    for (const render::MovedInstance& moved : frame.scene->moved()) {
      const Box both = unite(moved.before, moved.now);
      boxes_.push_back({glm::vec3(both.min), glm::vec3(both.max)});
    }
  known_ = true;
  scene_ = KnownScene(frame.scene);
  casters_ = frame.casters;
  light_ = frame.light;
  updates_ = updates;
  if (boxes_.empty()) return;
  gpu::Buffer& buffer = buffers_[frame.index % buffers_.size()];
  const uint64_t most = frame.scene->moving_instances().size() * sizeof(shared::ChangedBox);
  if (buffer.size() < most) buffer = gpu::Buffer(device_, "changed boxes", most, gpu::HostAccess::write);
  std::copy(boxes_.begin(), boxes_.end(), buffer.mapped<shared::ChangedBox>().begin());
}

std::vector<Allocation> CasterChanges::allocations() const {
  std::vector<Allocation> result;
  for (const gpu::Buffer& buffer : buffers_)
    if (buffer) result.push_back(buffer.allocation());
  return result;
}

}  // namespace shadewright::shadow
