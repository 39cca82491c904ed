// Placing things until a scene's triangles are spent.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "scene/builtin/stage.h"

namespace shadewright::builtin {

class Budget {
 public:
  Budget(Scene& scene, size_t triangles) : scene_(scene), total_(triangles) {}

  /// False, and nothing placed, when `prop` no longer fits.
  bool add(const Prop& prop, const glm::dmat4& where, const std::optional<glm::vec3>& dye = std::nullopt) {
    const size_t count = builtin::triangle_count(scene_, prop);
    if (spent_ + count > total_) return false;
    spent_ += count;
    place(scene_, prop, where, dye);
    return true;
  }
  /// Less than a fiftieth is left.
  bool nearly_spent() const { return spent_ + total_ / 50 > total_; }

 private:
  Scene& scene_;
  size_t total_, spent_ = 0;
};

}  // namespace shadewright::builtin
