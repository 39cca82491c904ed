// Superpages of 1,024 x 1,024 texels, into which RMSM bins the pages to draw (algorithm 2, step 10): each is drawn by
// one pass over the casters, and its pages are copied out of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadow/parameterization/paged/shared.h"

namespace shadewright::shadow {

struct Superpage : shared::SuperpagePlace {
  uint32_t first = 0, page_count = 0;  ///< its pages' place in the list
};

/// Fills `superpages` with those that hold a page of `mask` (a bit a page, `words_of_face` words a face, whose coarsest
/// level is `top`), and `pages` with their pages' numbers. Pages are numbered so that a superpage's follow each other:
/// the mask holds them sorted. Not more than `pages` has room for.
void bin_superpages(std::span<const uint32_t> mask, uint32_t words_of_face, uint32_t top, std::span<uint32_t> pages,
                    std::vector<Superpage>& superpages);

}  // namespace shadewright::shadow
