#include "options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "shadewright/error.h"
#include "shadewright/files.h"
#include "shadewright/scene/points.h"

namespace shadewright::app {

namespace {

constexpr uint32_t default_frames = 30;

/// "X,Y,Z" to N numbers; InputError naming the flag.
template <size_t N>
std::array<double, N> parse_numbers(const std::string& flag, const std::string& text, const char* shape) {
  std::array<double, N> values{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (size_t i = 0; i < N; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool last = i + 1 == N;
    if (error != std::errc() || !std::isfinite(values[i]) || (last ? next != end : next == end || *next != ','))
      throw InputError(fmt::format("{} {}", flag, text), "it does not have the form",
                       fmt::format("write {} {}", flag, shape));
    at = next + (last ? 0 : 1);
  }
  return values;
}

/// Azimuth and elevation, degrees.
glm::dvec2 parse_sun(const std::string& flag, const std::string& text) {
  const auto angles = parse_numbers<2>(flag, text, "AZIMUTH,ELEVATION");
  if (std::abs(angles[1]) > 90)
    throw InputError(flag + " " + text, "the elevation is beyond 90 degrees", "give -90 to 90");
  return {angles[0], angles[1]};
}

glm::dvec3 parse_point(const std::string& flag, const std::string& text) {
  const auto v = parse_numbers<3>(flag, text, "X,Y,Z");
  return {v[0], v[1], v[2]};
}

}  // namespace

void parse_size(const std::string& text, uint32_t& width, uint32_t& height) {
  uint32_t* const parts[] = {&width, &height};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int i = 0; i < 2; ++i) {
    const auto [next, error] = std::from_chars(at, end, *parts[i]);
    if (error != std::errc() || *parts[i] == 0 || *parts[i] > 16384 ||
        (i == 0 ? next == end || *next != 'x' : next != end))
      throw InputError("--size " + text, "it is not WxH with both from 1 to 16384", "write --size 1920x1080");
    at = next + (i == 0 ? 1 : 0);
  }
}

namespace {

Camera choose_camera(const SceneFlags& flags, const Scene& scene, std::vector<std::string>& notes) {
  if (!flags.camera.empty() && !flags.eye.empty())
    throw InputError("--camera", "it can't be given with --eye", "give one of them");
  if (flags.eye.empty() != flags.target.empty())
    throw InputError("--eye", "--eye and --target go together", "give both");
  Camera camera;
  if (!flags.camera.empty()) {
    camera = find_camera(scene, flags.camera);
  } else if (!flags.eye.empty()) {
    camera.name = "eye";
    camera.eye = parse_point("--eye", flags.eye) - scene.origin;
    camera.target = parse_point("--target", flags.target) - scene.origin;
    if (camera.eye == camera.target)
      throw InputError("--target " + flags.target, "it is the same point as --eye", "look elsewhere");
  } else if (!scene.cameras.empty()) {
    camera = scene.cameras.front();
    if (scene.cameras.size() > 1)
      notes.push_back(fmt::format("camera '{}', the first of {}", camera.name, scene.cameras.size()));
  } else {
    camera = default_camera(scene);
    const glm::dvec3 eye = camera.eye + scene.origin, target = camera.target + scene.origin;
    notes.push_back(fmt::format(
        "the scene has no camera: --eye {:.10g},{:.10g},{:.10g} --target {:.10g},{:.10g},{:.10g} was chosen", eye.x,
        eye.y, eye.z, target.x, target.y, target.z));
  }
  if (flags.fov) camera.fov_y = glm::radians(*flags.fov);
  return camera;
}

/// The frames that --path, --frames and --sun-to ask for; empty if none of them is given.
std::vector<Moment> choose_moments(const SceneFlags& flags, const Scene& scene, const Light& light,
                                   std::vector<std::string>& notes) {
  const bool sun_turns = !flags.sun_to.empty();
  if (flags.path.empty() && flags.frames == 0 && !sun_turns) return {};
  const uint32_t count = flags.frames == 0 ? default_frames : flags.frames;
  std::vector<Moment> moments;
  if (!flags.path.empty()) {
    if (!flags.camera.empty() || !flags.eye.empty() || !flags.target.empty())
      throw InputError("--path " + flags.path, "the path moves the camera, --camera, --eye and --target set it",
                       "leave one of them out");
    moments = moments_along(find_path(scene, flags.path), light, count);
    if (flags.fov)
      for (Moment& moment : moments) moment.camera.fov_y = glm::radians(*flags.fov);
  } else {
    if (scene.motions.empty() && !sun_turns)
      throw InputError(fmt::format("--frames {}", flags.frames), "nothing moves in this scene",
                       scene.paths.empty() ? "turn the sun with --sun-to AZIMUTH,ELEVATION"
                                           : "move the camera with --path " + scene.paths.front().name);
    moments = moments_of_motions(scene, choose_camera(flags, scene, notes), light, count);
  }
  if (sun_turns) {
    const glm::dvec2 to = parse_sun("--sun-to", flags.sun_to);
    if (light.kind != LightKind::directional)
      throw InputError("--sun-to " + flags.sun_to, fmt::format("the light '{}' is not a sun", light.name),
                       "give --sun AZIMUTH,ELEVATION as well");
    const glm::dvec2 from = flags.light.sun.empty() ? sun_angles(light) : parse_sun("--sun", flags.light.sun);
    turn_sun(moments, from, to);
    notes.push_back(fmt::format("the sun turns from {:.6g},{:.6g} to {:.6g},{:.6g}", from.x, from.y, to.x, to.y));
  }
  return moments;
}

}  // namespace

Light choose_light(const LightFlags& flags, const Scene& scene, std::vector<std::string>& notes) {
  if (!flags.light.empty() && !flags.sun.empty())
    throw InputError("--light", "it can't be given with --sun", "give one of them");
  if (!flags.light.empty()) return find_light(scene, flags.light);
  if (!flags.sun.empty()) {
    const glm::dvec2 angles = parse_sun("--sun", flags.sun);
    return sun(angles.x, angles.y);
  }
  if (!scene.lights.empty()) {
    if (scene.lights.size() > 1)
      notes.push_back(fmt::format("light '{}', the first of {}", scene.lights.front().name, scene.lights.size()));
    return scene.lights.front();
  }
  notes.push_back("the scene has no light: --sun 35,45 was chosen");
  return sun(35, 45);
}

Box parse_bounds(const std::string& flag, const std::string& text) {
  const auto v = parse_numbers<6>(flag, text, "X0,Y0,Z0,X1,Y1,Z1");
  const Box box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  if (box.empty())
    throw InputError(fmt::format("{} {}", flag, text), "a lower corner lies above the upper one",
                     "give the lower corner first");
  return box;
}

void check_range(const std::string& flag, double value, double min, double max) {
  // Not a number is outside too.
  if (!(value >= min && value <= max))
    throw InputError(fmt::format("{} {}", flag, value), fmt::format("it is not a number from {} to {}", min, max),
                     "give one that is");
}

void check_outputs(std::span<const Output> outputs) {
  std::map<std::filesystem::path, std::string> flags;
  for (const Output& output : outputs) {
    if (output.file.empty()) continue;
    const std::string subject = output.flag + " " + output.file;
    const std::filesystem::path file = std::filesystem::weakly_canonical(std::filesystem::absolute(output.file));
    const auto [other, first] = flags.emplace(output.file == "-" ? "-" : file, output.flag);
    if (!first) throw InputError(subject, other->second + " goes there too", "name another file");
    if (output.file == "-") continue;
    if (std::filesystem::is_directory(file)) throw InputError(subject, "it is a folder", "name a file in it");
    if (!std::filesystem::is_directory(file.parent_path()))
      throw InputError(
          subject,
          fmt::format("its folder '{}' does not exist", std::filesystem::path(output.file).parent_path().string()),
          "make it first");
  }
}

void write_text(const std::string& text, const std::string& file) {
  if (file == "-")
    write_standard_output(text);
  else
    write_file(file, text);
}

void LightFlags::add_to(CLI::App& verb) {
  verb.add_option("--light", light, "A light of the scene, by name");
  verb.add_option("--sun", sun, "Direction towards the sun, AZIMUTH,ELEVATION in degrees (azimuth 0 = +X, 90 = +Z)");
}

void SceneFlags::add_view_to(CLI::App& verb) {
  verb.add_option("SCENE", scene, "A file (glTF, GLB, OBJ, ...) or builtin:NAME[?key=value&...]")->required();
  verb.add_option("--camera", camera, "A camera of the scene, by name");
  verb.add_option("--eye", eye, "Camera position X,Y,Z, in the file's coordinates");
  verb.add_option("--target", target, "What the camera looks at, X,Y,Z");
  verb.add_option("--fov", fov, "Full vertical field of view, degrees, 1 to 160");
  light.add_to(verb);
  verb.add_option("--size", size, "Image size WxH in pixels")->capture_default_str();
  verb.add_option("--device", device, "Device by index or part of its name (see shadewright devices)");
  verb.add_flag("--quiet", quiet, "No progress, no remarks");
  verb.add_flag("--verbose", verbose, "Say more");
  verb.add_flag("--validation", validation, "Run with the Khronos validation layer; any message is an error");
}

void SceneFlags::add_to(CLI::App& verb) {
  add_view_to(verb);
  verb.add_option("--repeat", repeat, "Timed repeats after warm-up")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000));
  verb.add_option("--reference-samples", reference_samples, "Samples a pixel of the filtered reference")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  verb.add_option("--path", path,
                  "Move along a camera path of the scene, by name, with its animation running; each frame once");
  verb.add_option("--frames", frames,
                  fmt::format("Frames, evenly over the whole path (default {}); without --path the camera keeps still "
                              "while the scene's animation runs",
                              default_frames))
      ->check(CLI::Range(1, 100000));
  verb.add_option("--sun-to", sun_to, "Turn the sun from --sun (or the scene's) to AZIMUTH,ELEVATION over the frames");
  verb.add_option("--points", points,
                  "Draw far instances as points: off, auto (samples at most 2 pixels away), or that many pixels; "
                  "image, maps and truth show the same points")
      ->capture_default_str();
  verb.add_option("--debug", debug, "Also write a debug image of the technique, by name; repeatable; 'list' names them")
      ->allow_extra_args(false);
}

namespace {

/// The pixels between samples that --points asks for; none = triangles only.
std::optional<double> point_spacing(const std::string& text) {
  if (text == "off") return std::nullopt;
  if (text == "auto") return PointOptions{}.spacing;
  const double spacing = parse_numbers<1>("--points", text, "off, auto or a number of pixels")[0];
  if (spacing <= 0 || spacing > 1000)
    throw InputError("--points " + text, "the distance of samples must be more than 0 and at most 1000 pixels",
                     "write --points auto");
  return spacing;
}

}  // namespace

View load_view(const SceneFlags& flags, ProgressBar& bar, const Progress& progress) {
  View view;
  if (flags.fov) check_range("--fov", *flags.fov, 1, 160);
  parse_size(flags.size, view.width, view.height);
  const std::optional<double> spacing = point_spacing(flags.points);
  LoadedScene loaded = load_scene(flags.scene, progress);
  bar.clear();
  view.scene = std::move(loaded.scene);
  view.notes = std::move(loaded.warnings);
  view.light = choose_light(flags.light, view.scene, view.notes);
  view.path = flags.path;
  view.moments = choose_moments(flags, view.scene, view.light, view.notes);
  view.camera = view.moments.empty() ? choose_camera(flags, view.scene, view.notes) : view.moments.front().camera;
  // Bakes must know what a camera stands in.
  if (view.moments.empty() && flags.camera.empty()) view.scene.cameras.push_back(view.camera);
  if (spacing) {
    std::vector<PointView> seen;
    if (view.moments.empty()) seen.push_back(point_view(view.camera, view.height));
    for (const Moment& moment : view.moments) seen.push_back(point_view(moment.camera, view.height, moment.time));
    PointSummary summary;
    view.scene = with_points(view.scene, seen, {.spacing = *spacing}, &summary, progress);
    bar.clear();
    view.notes.push_back(describe(summary));
  }
  if (!flags.quiet)
    for (const std::string& note : view.notes) fmt::print(stderr, "{}\n", note);
  if (flags.verbose)
    fmt::print(stderr, "{}: {} triangles, {} meshes, {} instances\n", view.scene.name, triangle_count(view.scene),
               view.scene.meshes.size(), view.scene.instances.size());
  return view;
}

void print_later_notes(std::span<const std::string> notes, const View& view) {
  for (const std::string& note : notes)
    if (std::ranges::find(view.notes, note) == view.notes.end()) fmt::print(stderr, "{}\n", note);
}

void check_specs(std::span<const shadow::Spec> specs, const View& view) {
  std::vector<Light> lights{view.light};
  for (const Moment& moment : view.moments)
    if (moment.light.direction != lights.back().direction || moment.light.position != lights.back().position)
      lights.push_back(moment.light);
  for (const shadow::Spec& spec : specs)
    for (const Light& light : lights) shadow::check(spec, view.scene, light);
}

gpu::DeviceOptions device_options(const SceneFlags& flags) {
  return {flags.device, flags.validation};
}

void check_validation(const gpu::Device& device) {
  const auto messages = device.validation_messages();
  if (!messages.empty())
    throw FailureError("validation layer",
                       fmt::format("{} messages, the first: {}", messages.size(), messages.front()));
}

}  // namespace shadewright::app
