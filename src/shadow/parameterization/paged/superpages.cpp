#include "shadow/parameterization/paged/superpages.h"

#include <bit>

namespace shadewright::shadow {

namespace {

constexpr uint32_t superpage_pages =
    (shared::superpage_texels / shared::page_texels) * (shared::superpage_texels / shared::page_texels);

}  // namespace

void bin_superpages(std::span<const uint32_t> mask, uint32_t words_of_face, uint32_t top, std::span<uint32_t> pages,
                    std::vector<Superpage>& superpages) {
  superpages.clear();
  uint32_t listed = 0;
  for (uint32_t word = 0; word < mask.size(); ++word) {
    if (mask[word] == 0) continue;
    const uint32_t face = word / words_of_face, first_number = word % words_of_face * 32;
    uint32_t k = 0;
    while (shared::page_base(k + 1) <= first_number) ++k;
    // No word has pages of two superpages.
    const uint32_t within_level = first_number - shared::page_base(k);
    const Superpage here{
        {face, top - k, shared::z_curve_place(within_level / superpage_pages * superpage_pages)}, listed, 0};
    if (superpages.empty() || superpages.back().face != here.face || superpages.back().level != here.level ||
        superpages.back().first_page != here.first_page)
      superpages.push_back(here);
    for (uint32_t bits = mask[word]; bits != 0 && listed < pages.size(); bits &= bits - 1) {
      pages[listed++] = word * 32 + static_cast<uint32_t>(std::countr_zero(bits));
      ++superpages.back().page_count;
    }
  }
}

}  // namespace shadewright::shadow
