#include "compare/delta.h"

namespace shadewright::compare {

bool has_delta(const Picture& picture, const Picture& base) {
  return picture.width == base.width && picture.height == base.height && opaque(picture) && opaque(base);
}

Picture delta(const Picture& picture, const Picture& base) {
  Picture result = picture;
  for (size_t i = 0; i < result.pixels.size(); ++i)
    if (picture.pixels[i] == base.pixels[i]) result.pixels[i] = glm::u8vec4(0);
  return result;
}

}  // namespace shadewright::compare
