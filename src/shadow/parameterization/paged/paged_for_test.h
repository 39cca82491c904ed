// What tests of paged maps share.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gpu/device_for_test.h"
#include "shadewright/compare/study.h"

namespace shadewright::compare {

class PagedTest : public gpu::DeviceTest {
 protected:
  static StudyOptions small() { return {384, 384, 0, 0, true}; }
  /// A light a little above what the scene's first camera looks at.
  static Light lamp(const Scene& scene, LightKind kind) {
    Light lamp;
    lamp.position = scene.cameras.front().target + glm::dvec3(0.3, 1.1, 0.2);
    lamp.kind = kind;
    return lamp;
  }
  static TechniqueResult run(Study& study, const std::string& spec) {
    return study.run(shadow::parse_spec(spec)).result;
  }
  /// With the picture "page-use".
  static Outcome run_with_table(Study& study, const std::string& spec) {
    return study.run(shadow::parse_spec(spec), std::vector<std::string>{"page-use"});
  }
  /// How much of each page in the pool is used, 0 to 1, from that picture of a sun's.
  static std::vector<double> use_of_pages(const Picture& picture) {
    std::vector<double> use;
    for (uint32_t side = picture.height, left = 0, top = 0; side > 0; side /= 2) {
      for (uint32_t y = top; y < top + side; ++y)
        for (uint32_t x = left; x < left + side; ++x) {
          const glm::u8vec4 color = picture.pixels[size_t{y} * picture.width + x];
          if (color.r == color.g) use.push_back(color.r / 255.0);
        }
      if (left > 0) top += side;
      left = picture.height;
    }
    return use;
  }
  static double counter(const TechniqueResult& result, const char* name) { return result.counters.at(name).front(); }
};

}  // namespace shadewright::compare
