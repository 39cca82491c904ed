// Superpages of 1,024 x 1,024 texels, into which RMSM bins the pages to draw (algorithm 2, step 10): each is drawn by
// one pass over the casters, and its pages are copied out of it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace shadewright::shadow {

struct Superpage {
  uint32_t face = 0, level = 0;
  glm::uvec2 first_page{0};            ///< of its level, at its corner
  uint32_t first = 0, page_count = 0;  ///< its pages' place in the list
  bool operator==(const Superpage&) const = default;
};

/// Number of the first page of the level with 4^k pages, and the place of a level's page by its number (pages.glsl).
uint32_t first_page_number(uint32_t k);
glm::uvec2 page_place(uint32_t number);

/// Fills `superpages` with those that hold a page of `mask` (a bit a page, `words_of_face` words a face, whose coarsest
/// level is `top`), and `pages` with their pages' numbers. Pages are numbered so that a superpage's follow each other:
/// the mask holds them sorted. Not more than `pages` has room for.
void bin_superpages(std::span<const uint32_t> mask, uint32_t words_of_face, uint32_t top, std::span<uint32_t> pages,
                    std::vector<Superpage>& superpages);

}  // namespace shadewright::shadow
