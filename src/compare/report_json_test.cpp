#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "compare/report_fixture.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  return names;
}

using Names = std::vector<std::string>;

TEST(ReportJson, KeysAndTheirOrderAreTheContract) {
  const std::string text = to_json(example_report());
  EXPECT_TRUE(text.ends_with("}\n"));
  EXPECT_TRUE(text.starts_with("{\n  \"schema\": \"shadewright.compare/1\",\n"));
  const Json json = Json::parse(text);
  EXPECT_EQ(keys(json), (Names{"schema", "scene", "device", "image", "camera", "light", "reference", "camera_pass",
                               "results", "notes"}));
  EXPECT_EQ(keys(json["scene"]), (Names{"name", "triangles", "instances"}));
  EXPECT_EQ(keys(json["device"]), (Names{"name", "type"}));
  EXPECT_EQ(keys(json["camera"]), (Names{"name", "eye", "target", "up", "fov_degrees", "near"}));
  EXPECT_EQ(keys(json["light"]), (Names{"name", "kind", "direction_to_light"}));
  const Json& result = json["results"][0];
  EXPECT_EQ(keys(result), (Names{"technique", "spec", "error", "milliseconds", "frame_milliseconds", "memory_bytes",
                                 "memory", "counters", "images"}));
  EXPECT_EQ(keys(result["error"]),
            (Names{"wrong", "compared", "image_pixels", "fraction", "match", "false_shadow", "false_lit",
                   "interior_false_shadow", "interior_false_lit", "oracle_fraction", "edge_pixels", "boundary_pixels",
                   "boundary_fraction", "mean_absolute", "flicker"}));
  EXPECT_EQ(keys(result["milliseconds"]), (Names{"median", "min", "max", "stages"}));
}

TEST(ReportJson, ValuesAreWrittenAsTheyAre) {
  const Json json = Json::parse(to_json(example_report()));
  EXPECT_EQ(json["camera"]["fov_degrees"], 50.0);
  EXPECT_EQ(json["results"][0]["memory_bytes"], (4u << 20) + 1200);
  EXPECT_TRUE(json["results"][0]["error"]["oracle_fraction"].is_null());
  EXPECT_TRUE(json["results"][0]["error"]["flicker"].is_null());
  EXPECT_EQ(json["results"][1]["error"]["flicker"], 0.01);
  const Json& counters = json["results"][1]["counters"];
  EXPECT_EQ(counters["effective_resolution"], Json::array({4096, 2048}));
  EXPECT_TRUE(counters["pages"].is_number_integer());
  EXPECT_EQ(counters["warp"], 1.5);
}

TEST(ReportJson, ReadingBackGivesTheSameReport) {
  const std::string text = to_json(example_report());
  const Report report = from_json(text, "report.json");
  EXPECT_EQ(to_json(report), text);
  EXPECT_EQ(report.results[1].counters.at("effective_resolution"), (std::vector<double>{4096, 2048}));
  EXPECT_FALSE(report.results[0].error.flicker.has_value());
  EXPECT_NEAR(report.camera.fov_y, example_report().camera.fov_y, 1e-10);
  EXPECT_EQ(report.light.direction, example_report().light.direction);
}

TEST(ReportJson, APathAndItsFramesSurvive) {
  Report report = example_report();
  EXPECT_FALSE(from_json(to_json(report), "report.json").path.has_value());
  report.path = ReportPath{"main", 2, 0.5, 12.25, 1, true};
  const Report read = from_json(to_json(report), "report.json");
  EXPECT_EQ(to_json(read), to_json(report));
  ASSERT_TRUE(read.path.has_value());
  EXPECT_EQ(read.path->name, "main");
  EXPECT_EQ(read.path->frames, 2u);
  EXPECT_EQ(read.path->last_time, 12.25);
  EXPECT_TRUE(read.path->light_moves);
  ASSERT_EQ(read.results[1].frames.size(), 2u);
  EXPECT_EQ(read.results[1].frames[1].wrong, 19u);
  EXPECT_EQ(read.results[1].frames[1].flicker, 0.01);
}

TEST(ReportJson, EveryKindOfLightSurvives) {
  for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
    Report report = example_report();
    report.light.kind = kind;
    report.light.position = {1, 2, 3};
    report.light.direction = {0, -1, 0};
    const std::string text = to_json(report);
    EXPECT_EQ(text.find("-0.0"), std::string::npos);
    EXPECT_EQ(to_json(from_json(text, "report.json")), text);
    EXPECT_EQ(from_json(text, "report.json").light.kind, kind);
  }
}

TEST(ReportJson, NothingComparedAndNothingFiniteStaysNumeric) {
  Report report;
  report.results.resize(1);
  report.results[0].error.fraction = std::numeric_limits<double>::quiet_NaN();
  report.results[0].milliseconds.median = std::numeric_limits<double>::infinity();
  report.results[0].counters["strange"] = {std::numeric_limits<double>::quiet_NaN()};
  const Json json = Json::parse(to_json(report));
  EXPECT_EQ(json["results"][0]["error"]["fraction"], 0.0);
  EXPECT_EQ(json["results"][0]["milliseconds"]["median"], 0.0);
  EXPECT_EQ(json["results"][0]["counters"]["strange"], 0.0);
  EXPECT_EQ(to_json(from_json(to_json(report), "x")), to_json(report));
}

TEST(ReportJson, NamesThatAreNotUtf8AreReplaced) {
  Report report = example_report();
  report.scene_name = "caf\xe9.glb";
  EXPECT_EQ(Json::parse(to_json(report))["scene"]["name"], "caf\xef\xbf\xbd.glb");
}

TEST(ReportJson, UnknownKeysAreIgnoredAndOursMayBeMissing) {
  Json json = Json::parse(to_json(example_report()));
  json["more"] = {{"to", "come"}};
  json.erase("notes");
  json["camera"] = Json::object();
  json["light"] = Json::object();
  json["results"][0].erase("images");
  const Report report = from_json(json.dump(), "report.json");
  EXPECT_TRUE(report.notes.empty());
  EXPECT_EQ(report.results.size(), 2u);
}

std::string refusal(const std::string& text) {
  try {
    from_json(text, "old.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(ReportJson, AnythingElseIsRefusedByName) {
  const auto refused = [](const std::string& text, const std::string& why) {
    const std::string message = refusal(text);
    EXPECT_TRUE(message.starts_with("old.json: not a comparison report (")) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  };
  refused("", "parse error");
  refused("[]", "array");
  refused("{}", "'schema' not found");
  refused(R"({"schema": "shadewright.compare/9"})", "shadewright.compare/9");
  Json json = Json::parse(to_json(example_report()));
  json["results"][0]["error"]["wrong"] = -1;
  refused(json.dump(), "`wrong` is not a count");
  json = Json::parse(to_json(example_report()));
  json["light"]["kind"] = "area";
  refused(json.dump(), "`area`");
  json = Json::parse(to_json(example_report()));
  json["results"] = {{"a", 1}};
  refused(json.dump(), "`results` is not a list");
  json["results"] = Json::array();
  json["camera"]["eye"] = Json::array({1, 2});
  refused(json.dump(), "not a comparison report");
}

}  // namespace
}  // namespace shadewright::compare
