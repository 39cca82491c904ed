#include "compare/difference.h"

namespace shadewright::compare {

Picture difference_picture(const MetricsInput& input) {
  Picture picture{input.width, input.height, {}};
  picture.pixels.assign(size_t{input.width} * input.height, glm::u8vec4(0));
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    if (input.facing[i] == 0) continue;
    const bool truth = input.reference[i] != 0, answer = lit(input.visibility[i]);
    if (truth != answer) picture.pixels[i] = truth ? false_shadow_color : false_lit_color;
  }
  return picture;
}

}  // namespace shadewright::compare
