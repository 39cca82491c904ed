#include "state.h"

#include <fmt/format.h>

#include <algorithm>

#include "shadewright/error.h"

namespace shadewright::viewer {

namespace {

/// As one word of a shell's command.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

}  // namespace

void SideChoice::set(const std::string& wanted) {
  text = wanted;
  problem.clear();
  try {
    spec = shadow::parse_spec(wanted);
  } catch (const InputError& error) {
    problem = error.what();
  }
}

double duration(const Scene& scene, const std::string& path) {
  if (!path.empty()) return find_path(scene, path).times.back();
  double last = 0;
  for (const Motion& motion : scene.motions)
    if (!motion.times.empty()) last = std::max(last, motion.times.back());
  return last;
}

std::string compare_command(const State& state, const Told& told) {
  // In the file's coordinates, as the command line takes them.
  const glm::dvec3 eye = state.camera.eye + told.scene->origin, target = state.camera.target + told.scene->origin;
  std::string command = fmt::format(
      "shadewright compare {} --eye={:.10g},{:.10g},{:.10g} --target={:.10g},{:.10g},{:.10g} --fov {:.6g}",
      quoted(told.scene_source), eye.x, eye.y, eye.z, target.x, target.y, target.z, glm::degrees(state.camera.fov_y));
  if (state.light.kind == LightKind::directional)
    command += fmt::format(" --sun={:.6g},{:.6g}", state.sun.x, state.sun.y);
  else
    command += " --light " + quoted(state.light.name);
  command += fmt::format(" --size {}x{}", told.picture.width, told.picture.height);
  for (const size_t side : {left, right})
    if (state.sides[side].spec && (side == left || state.compares))
      command += " -t " + quoted(state.sides[side].spec->text);
  return command + " -o out/view";
}

}  // namespace shadewright::viewer
