// report.json: the contract of architecture section 5, in its order of keys, and back.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "shadewright/compare/report.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view schema = "shadewright.compare/1";

// JSON has no word for infinity or not-a-number; a reader must always find a number.
double finite(double value) {
  return std::isfinite(value) ? value : 0.0;
}

Json optional_number(const std::optional<double>& value) {
  return value ? Json(finite(*value)) : Json(nullptr);
}

// Adding zero turns -0 into 0.
Json vector(const glm::dvec3& v) {
  return Json::array({finite(v.x) + 0.0, finite(v.y) + 0.0, finite(v.z) + 0.0});
}

// Rounded, so that 50 degrees stay "50.0" on their way through radians.
double degrees(double radians) {
  return std::round(finite(glm::degrees(radians)) * 1e9) / 1e9;
}

std::string_view kind_name(LightKind kind) {
  switch (kind) {
    case LightKind::spot:
      return "spot";
    case LightKind::point:
      return "point";
    case LightKind::directional:
      break;
  }
  return "directional";
}

Json camera_json(const Camera& camera) {
  return {{"name", camera.name},
          {"eye", vector(camera.eye)},
          {"target", vector(camera.target)},
          {"up", vector(camera.up)},
          {"fov_degrees", degrees(camera.fov_y)},
          {"near", finite(camera.near)}};
}

Json light_json(const Light& light) {
  Json json = {{"name", light.name}, {"kind", kind_name(light.kind)}};
  if (light.kind != LightKind::point) json["direction_to_light"] = vector(-light.direction);
  if (light.kind != LightKind::directional) json["position"] = vector(light.position);
  if (light.kind == LightKind::spot) json["outer_angle_degrees"] = degrees(light.outer_angle);
  return json;
}

Json path_json(const ReportPath& path) {
  return {{"name", path.name},
          {"frames", path.frames},
          {"first_time", finite(path.first_time)},
          {"last_time", finite(path.last_time)},
          {"pictured", path.pictured},
          {"light_moves", path.light_moves}};
}

Json frames_json(const std::vector<FrameFigures>& frames) {
  Json json = Json::array();
  for (const FrameFigures& frame : frames)
    json.push_back(
        {{"wrong", frame.wrong}, {"flicker", finite(frame.flicker)}, {"milliseconds", finite(frame.milliseconds)}});
  return json;
}

Json error_json(const ErrorFigures& error) {
  return {{"wrong", error.wrong},
          {"compared", error.compared},
          {"image_pixels", error.image_pixels},
          {"fraction", finite(error.fraction)},
          {"match", finite(error.match)},
          {"false_shadow", error.false_shadow},
          {"false_lit", error.false_lit},
          {"interior_false_shadow", error.interior_false_shadow},
          {"interior_false_lit", error.interior_false_lit},
          {"oracle_fraction", optional_number(error.oracle_fraction)},
          {"edge_pixels", error.edge_pixels},
          {"boundary_pixels", error.boundary_pixels},
          {"boundary_fraction", finite(error.boundary_fraction)},
          {"mean_absolute", finite(error.mean_absolute)},
          {"flicker", optional_number(error.flicker)}};
}

// A whole number is written as one: counters are mostly counts.
Json counter_value(double value) {
  constexpr double largest_exact = 9007199254740992.0;
  value = finite(value);
  if (std::trunc(value) == value && std::abs(value) <= largest_exact) return static_cast<int64_t>(value);
  return value;
}

Json counter_json(const std::vector<double>& values) {
  if (values.size() == 1) return counter_value(values.front());
  Json json = Json::array();
  for (const double value : values) json.push_back(counter_value(value));
  return json;
}

Json result_json(const TechniqueResult& result) {
  Json stages = Json::array(), memory = Json::array(), counters = Json::object();
  for (const StageTime& stage : result.milliseconds.stages)
    stages.push_back({{"name", stage.name}, {"median", finite(stage.median)}});
  for (const Allocation& allocation : result.memory)
    memory.push_back({{"name", allocation.name}, {"bytes", allocation.bytes}});
  for (const auto& [name, values] : result.counters) counters[name] = counter_json(values);
  Json json = {{"technique", result.technique},
               {"spec", result.spec},
               {"error", error_json(result.error)},
               {"milliseconds",
                {{"median", finite(result.milliseconds.median)},
                 {"min", finite(result.milliseconds.min)},
                 {"max", finite(result.milliseconds.max)},
                 {"stages", stages}}},
               {"frame_milliseconds", {{"median", finite(result.frame_milliseconds)}}},
               {"memory_bytes", result.memory_bytes()},
               {"memory", memory},
               {"counters", counters},
               {"images", {{"image", result.image}, {"mask", result.mask}, {"difference", result.difference}}}};
  if (!result.debug.empty()) json["debug"] = result.debug;
  if (!result.frames.empty()) json["frames"] = frames_json(result.frames);
  return json;
}

// Reading. The contract's keys must be there; what we added to it, and the contents of camera and light, may be
// missing.

const Json& member(const Json& json, const char* key) {
  return json.at(key);
}

std::string text(const Json& json, const char* key) {
  return member(json, key).get<std::string>();
}
double number(const Json& json, const char* key) {
  return member(json, key).get<double>();
}

uint64_t whole(const Json& json, const char* key) {
  const Json& value = member(json, key);
  if (!value.is_number_unsigned()) throw Error(std::string("`") + key + "` is not a count");
  return value.get<uint64_t>();
}

std::optional<double> optional_value(const Json& json, const char* key) {
  const Json& value = member(json, key);
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

const Json& list(const Json& json, const char* key) {
  const Json& value = member(json, key);
  if (!value.is_array()) throw Error(std::string("`") + key + "` is not a list");
  return value;
}

glm::dvec3 read_vector(const Json& json, const char* key, const glm::dvec3& otherwise) {
  if (!json.contains(key)) return otherwise;
  const auto values = json.at(key).get<std::array<double, 3>>();
  return {values[0], values[1], values[2]};
}

double read_degrees(const Json& json, const char* key, double otherwise_radians) {
  return json.contains(key) ? glm::radians(number(json, key)) : otherwise_radians;
}

Camera read_camera(const Json& json) {
  Camera camera;
  camera.name = json.value("name", camera.name);
  camera.eye = read_vector(json, "eye", camera.eye);
  camera.target = read_vector(json, "target", camera.target);
  camera.up = read_vector(json, "up", camera.up);
  camera.fov_y = read_degrees(json, "fov_degrees", camera.fov_y);
  camera.near = json.value("near", camera.near);
  return camera;
}

Light read_light(const Json& json) {
  Light light;
  light.name = json.value("name", light.name);
  const std::string kind = json.value("kind", std::string("directional"));
  for (const LightKind known : {LightKind::directional, LightKind::spot, LightKind::point})
    if (kind == kind_name(known)) light.kind = known;
  if (kind != kind_name(light.kind)) throw Error("unknown kind of light `" + kind + "`");
  light.direction = -read_vector(json, "direction_to_light", -light.direction) + 0.0;
  light.position = read_vector(json, "position", light.position);
  light.outer_angle = read_degrees(json, "outer_angle_degrees", light.outer_angle);
  return light;
}

ErrorFigures read_error(const Json& json) {
  ErrorFigures error;
  error.wrong = whole(json, "wrong");
  error.compared = whole(json, "compared");
  error.image_pixels = whole(json, "image_pixels");
  error.fraction = number(json, "fraction");
  error.match = number(json, "match");
  error.false_shadow = whole(json, "false_shadow");
  error.false_lit = whole(json, "false_lit");
  error.interior_false_shadow = whole(json, "interior_false_shadow");
  error.interior_false_lit = whole(json, "interior_false_lit");
  error.oracle_fraction = optional_value(json, "oracle_fraction");
  error.edge_pixels = whole(json, "edge_pixels");
  error.boundary_pixels = json.value("boundary_pixels", uint64_t{0});
  error.boundary_fraction = number(json, "boundary_fraction");
  error.mean_absolute = number(json, "mean_absolute");
  error.flicker = optional_value(json, "flicker");
  return error;
}

TechniqueResult read_result(const Json& json) {
  TechniqueResult result;
  result.technique = text(json, "technique");
  result.spec = text(json, "spec");
  result.error = read_error(member(json, "error"));
  const Json& milliseconds = member(json, "milliseconds");
  result.milliseconds.median = number(milliseconds, "median");
  result.milliseconds.min = number(milliseconds, "min");
  result.milliseconds.max = number(milliseconds, "max");
  for (const Json& stage : list(milliseconds, "stages"))
    result.milliseconds.stages.push_back({text(stage, "name"), number(stage, "median")});
  result.frame_milliseconds = number(member(json, "frame_milliseconds"), "median");
  for (const Json& allocation : list(json, "memory"))
    result.memory.push_back({text(allocation, "name"), whole(allocation, "bytes")});
  for (const auto& [name, value] : member(json, "counters").items())
    result.counters[name] =
        value.is_array() ? value.get<std::vector<double>>() : std::vector<double>{value.get<double>()};
  const Json images = json.value("images", Json::object());
  for (const Json& frame : json.value("frames", Json::array()))
    result.frames.push_back({whole(frame, "wrong"), number(frame, "flicker"), number(frame, "milliseconds")});
  result.image = images.value("image", std::string());
  result.mask = images.value("mask", std::string());
  result.difference = images.value("difference", std::string());
  result.debug = json.value("debug", result.debug);
  return result;
}

ReportPath read_path(const Json& json) {
  return {text(json, "name"),        json.at("frames").get<uint32_t>(),   number(json, "first_time"),
          number(json, "last_time"), json.at("pictured").get<uint32_t>(), json.at("light_moves").get<bool>()};
}

Report read_report(const Json& json) {
  if (const std::string found = text(json, "schema"); found != schema)
    throw Error("its schema is `" + found + "`, not `" + std::string(schema) + "`");
  Report report;
  const Json& scene = member(json, "scene");
  report.scene_name = text(scene, "name");
  report.triangles = whole(scene, "triangles");
  report.instances = whole(scene, "instances");
  report.device_name = text(member(json, "device"), "name");
  report.device_type = text(member(json, "device"), "type");
  report.width = member(json, "image").at("width").get<uint32_t>();
  report.height = member(json, "image").at("height").get<uint32_t>();
  report.camera = read_camera(member(json, "camera"));
  report.light = read_light(member(json, "light"));
  if (json.contains("path")) report.path = read_path(json["path"]);
  const Json& reference = member(json, "reference");
  report.reference_milliseconds = number(reference, "milliseconds");
  report.reference_lit_fraction = number(reference, "lit_fraction");
  const Json images = reference.value("images", Json::object());
  report.reference_image = images.value("image", std::string());
  report.reference_mask = images.value("mask", std::string());
  report.camera_pass_milliseconds = number(member(json, "camera_pass"), "milliseconds");
  report.notes = json.value("notes", report.notes);
  for (const Json& result : list(json, "results")) report.results.push_back(read_result(result));
  return report;
}

// "[json.exception.out_of_range.403] key 'x' not found" -> "key 'x' not found"
std::string without_tag(std::string_view message) {
  const size_t tag = message.starts_with('[') ? message.find("] ") : std::string_view::npos;
  return std::string(tag == std::string_view::npos ? message : message.substr(tag + 2));
}

}  // namespace

uint64_t TechniqueResult::memory_bytes() const {
  uint64_t bytes = 0;
  for (const Allocation& allocation : memory) bytes += allocation.bytes;
  return bytes;
}

std::string to_json(const Report& report) {
  Json results = Json::array();
  for (const TechniqueResult& result : report.results) results.push_back(result_json(result));
  Json json = {
      {"schema", schema},
      {"scene", {{"name", report.scene_name}, {"triangles", report.triangles}, {"instances", report.instances}}},
      {"device", {{"name", report.device_name}, {"type", report.device_type}}},
      {"image", {{"width", report.width}, {"height", report.height}}},
      {"camera", camera_json(report.camera)},
      {"light", light_json(report.light)},
      {"reference",
       {{"milliseconds", finite(report.reference_milliseconds)},
        {"lit_fraction", finite(report.reference_lit_fraction)},
        {"images", {{"image", report.reference_image}, {"mask", report.reference_mask}}}}},
      {"camera_pass", {{"milliseconds", finite(report.camera_pass_milliseconds)}}},
      {"results", results},
      {"notes", report.notes}};
  if (report.path) json["path"] = path_json(*report.path);
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Report from_json(const std::string& text, const std::string& name) {
  const auto refuse = [&name](const std::string& why) {
    return InputError(name, "not a comparison report (" + why + ")",
                      "give the report.json that `shadewright compare` wrote");
  };
  try {
    return read_report(Json::parse(text));
  } catch (const Json::exception& error) {
    throw refuse(without_tag(error.what()));
  } catch (const Error& error) {
    throw refuse(error.what());
  }
}

}  // namespace shadewright::compare
