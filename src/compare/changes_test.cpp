#include "compare/changes.h"

#include <gtest/gtest.h>

#include "compare/report_fixture.h"

namespace shadewright::compare {
namespace {

TEST(Changes, PairsBySpecAndKeepsTheNewOrder) {
  Report before = example_report(), after = example_report();
  before.results = {example_result("sm", "uniform/depth/hard@2048", 1), example_result("psm", "perspective", 2)};
  after.results = {example_result("vsm", "uniform/moments/pcf", 3),
                   example_result("uniform@2048", "uniform/depth/hard@2048", 4)};
  const auto changes = pair_results(before, after);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].before, nullptr);
  EXPECT_EQ(changes[0].after, &after.results[0]);
  EXPECT_EQ(changes[1].before, &before.results[0]);
  EXPECT_EQ(changes[1].after, &after.results[1]);
  EXPECT_EQ(changes[2].before, &before.results[1]);
  EXPECT_EQ(changes[2].after, nullptr);
}

TEST(Changes, RepeatedSpecsArePairedInOrder) {
  Report before = example_report(), after = example_report();
  before.results = {example_result("sm", "s", 1), example_result("sm", "s", 2)};
  after.results = before.results;
  const auto changes = pair_results(before, after);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].before, &before.results[0]);
  EXPECT_EQ(changes[1].before, &before.results[1]);
}

TEST(Changes, AlignedLines) {
  Report before = example_report(), after = example_report();
  after.results[0].error.wrong = 75;
  after.results[0].milliseconds.median = 3.0;
  after.results[0].memory = {{"shadow map", 16u << 20}};
  after.results[1].error.wrong = 40;
  before.results[1] = example_result("cpvs", "precomputed@16384", 7);
  EXPECT_EQ(describe_changes(before, after),
            "technique  wrong pixels        milliseconds            MB\n"
            "sm@2048    100 -> 75 (-25.0%)  1.50 -> 3.00 (+100.0%)  4.2 -> 16.8 (+299.9%)\n"
            "rtw@512      - -> 40              - -> 1.50              - ->  4.2            new\n"
            "cpvs         7 ->  -           1.50 ->    -            4.2 ->    -            gone\n");
}

TEST(Changes, OtherConditionsAreSaid) {
  const Report before = example_report();
  EXPECT_TRUE(changed_conditions(before, before).empty());
  EXPECT_TRUE(changed_conditions(before, from_json(to_json(before), "x")).empty());
  Report after = before;
  after.device_name = "RTX";
  after.width = 80;
  after.camera.eye.x += 0.1;
  after.light = sun(36, 45);
  const auto conditions = changed_conditions(before, after);
  ASSERT_EQ(conditions.size(), 4u);
  EXPECT_EQ(conditions[0], "the device differs: llvmpipe before, RTX now");
  EXPECT_EQ(conditions[1], "the image size differs: 40 x 30 before, 80 x 30 now");
  EXPECT_TRUE(describe_changes(before, after).starts_with("note: the device differs"));
}

}  // namespace
}  // namespace shadewright::compare
