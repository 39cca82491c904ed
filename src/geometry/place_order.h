// An order of places, so that the same ones come in the same order wherever they come from.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

namespace shadewright {

/// Along x first, then along y, then along z.
template <glm::length_t size, typename T>
bool comes_before(const glm::vec<size, T>& a, const glm::vec<size, T>& b) {
  for (glm::length_t axis = 0; axis + 1 < size; ++axis)
    if (a[axis] != b[axis]) return a[axis] < b[axis];
  return a[size - 1] < b[size - 1];
}

/// Sorts places, and leaves each once.
template <glm::length_t size, typename T>
void sort_distinct(std::vector<glm::vec<size, T>>& places) {
  std::sort(places.begin(), places.end(), comes_before<size, T>);
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

}  // namespace shadewright
