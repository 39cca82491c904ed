#include "shadewright/geometry/box.h"

namespace shadewright {

Box unite(const Box& a, const Box& b) {
  Box result = a;
  result.extend(b);
  return result;
}

Box intersect(const Box& a, const Box& b) {
  return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

Box transform(const glm::dmat4& to_from, const Box& box) {
  if (box.empty()) return box;
  const glm::dvec3 half = 0.5 * box.size();
  const glm::dvec3 center = glm::dvec3(to_from * glm::dvec4(box.center(), 1.0));
  glm::dvec3 extent(0.0);
  for (int axis = 0; axis < 3; ++axis) extent += glm::abs(glm::dvec3(to_from[axis])) * half[axis];
  return {center - extent, center + extent};
}

}  // namespace shadewright
