// A small report with every field set, for the tests of its written forms.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "shadewright/compare/report.h"

namespace shadewright::compare {

inline TechniqueResult example_result(const std::string& technique, const std::string& spec, uint64_t wrong) {
  TechniqueResult result;
  result.technique = technique;
  result.spec = spec;
  result.error.wrong = wrong;
  result.error.compared = 1000;
  result.error.image_pixels = 1200;
  result.error.fraction = static_cast<double>(wrong) / 1000;
  result.error.match = 1 - static_cast<double>(wrong) / 1200;
  result.error.false_shadow = wrong / 2;
  result.error.false_lit = wrong - wrong / 2;
  result.error.interior_false_shadow = 1;
  result.error.interior_false_lit = 2;
  result.error.edge_pixels = 90;
  result.error.boundary_fraction = 0.25;
  result.error.mean_absolute = 0.0625;
  result.milliseconds = {1.5, 1.25, 2.0, {{"map", 1.0}, {"look-up", 0.5}}};
  result.frame_milliseconds = 2.5;
  result.memory = {{"shadow map", 4u << 20}, {"visibility", 1200}};
  return result;
}

inline Report example_report() {
  Report report;
  report.scene_name = "builtin:courtyard";
  report.triangles = 60000;
  report.instances = 12;
  report.device_name = "llvmpipe";
  report.device_type = "cpu";
  report.width = 40;
  report.height = 30;
  report.camera = {"door", {1, 2, 3}, {4, 5, 6}, {0, 1, 0}, glm::radians(50.0), 0.125};
  report.light = sun(35, 45);
  report.light.name = "sun";
  report.reference_milliseconds = 12.5;
  report.reference_lit_fraction = 0.75;
  report.camera_pass_milliseconds = 1.0;
  report.reference_image = "truth.png";
  report.reference_mask = "truth_mask.png";
  report.notes = {"no camera in the file: a three-quarter view was chosen"};
  report.results = {example_result("sm@2048", "uniform/depth/hard@2048", 100),
                    example_result("rtw@512", "rectilinear/depth/hard@512", 40)};
  TechniqueResult& rtw = report.results.back();
  rtw.error.oracle_fraction = 0.0005;
  rtw.error.flicker = 0.01;
  rtw.frames = {{21, 0, 9.5}, {19, 0.01, 1.5}};
  rtw.counters = {{"effective_resolution", {4096, 2048}}, {"pages", {17}}, {"warp", {1.5}}};
  rtw.image = "rtw.png";
  rtw.mask = "rtw_mask.png";
  rtw.difference = "rtw_difference.png";
  rtw.debug = {"rtw-shadow-map.png"};
  return report;
}

}  // namespace shadewright::compare
