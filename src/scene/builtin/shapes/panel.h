// A wall made of cells of a grid, some left out: facades with window openings, battlements, gratings, broken walls.
// Closed, outward oriented, as long as no two filled cells touch at a corner only.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// Grid lines at `xs` and `ys` (ascending); cell (i, j) lies between xs[i], xs[i + 1] and ys[j], ys[j + 1], and is
/// solid from z = `back` to z = `front` where `filled(i, j)`.
Mesh panel(std::span<const double> xs, std::span<const double> ys, double back, double front,
           const std::function<bool(size_t, size_t)>& filled);

}  // namespace shadewright::builtin
