#include "panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "shadewright/scene/moments.h"

namespace shadewright::viewer {

namespace {

const ImVec4 warning(1.0f, 0.55f, 0.4f, 1.0f), faint(0.7f, 0.7f, 0.7f, 1.0f);

void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str());
}

void colored(const ImVec4& color, const std::string& line) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0.0f);
  text(line);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void tip(const std::string& line) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(30 * ImGui::GetFontSize());
  text(line);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

const char* shown(const std::string& name) {
  return name.empty() ? "(none)" : name.c_str();
}

/// A list of things with names, which may have the same ones; the index of the one that was chosen, one more for
/// `last`.
template <typename Thing>
std::optional<size_t> choose_one(const char* label, const std::string& chosen, const std::vector<Thing>& things,
                                 const char* last = nullptr) {
  std::optional<size_t> result;
  if (!ImGui::BeginCombo(label, shown(chosen))) return result;
  for (size_t i = 0; i < things.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(shown(things[i].name))) result = i;
    ImGui::PopID();
  }
  if (last && ImGui::Selectable(last)) result = things.size();
  ImGui::EndCombo();
  return result;
}

/// A list to choose one of; true when another was chosen.
template <typename Names>
bool choose(const char* label, std::string& chosen, const Names& names) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, shown(chosen))) return false;
  for (const std::string& name : names)
    if (ImGui::Selectable(shown(name), name == chosen)) {
      chosen = name;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

bool slider(const char* label, double& value, double min, double max, const char* format,
            ImGuiSliderFlags flags = ImGuiSliderFlags_None) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &min, &max, format,
                             flags | ImGuiSliderFlags_AlwaysClamp);
}

/// The control of one key; true with the new value in `value` when it was changed. What is being typed stays in
/// `choice` meanwhile.
bool edit_key(const shadow::SpecKey& key, std::string& value, SideChoice& choice) {
  using Kind = shadow::SpecKey::Kind;
  if (key.kind == Kind::choice) return choose(key.name.c_str(), value, key.choices);
  if (choice.edited_key == key.name) value = choice.edited_value;
  if (key.kind == Kind::whole || key.kind == Kind::number) {
    double number = std::stod(value);
    const bool whole = key.kind == Kind::whole;
    ImGui::InputDouble(key.name.c_str(), &number, whole ? 1 : 0, whole ? 1 : 0, "%.6g");
    value = fmt::format("{}", std::clamp(whole ? std::round(number) : number, key.min, key.max));
  } else {
    ImGui::InputText(key.name.c_str(), &value);
  }
  if (ImGui::IsItemActive()) {
    choice.edited_key = key.name;
    choice.edited_value = value;
  }
  if (ImGui::IsItemDeactivated() && choice.edited_key == key.name) choice.edited_key.clear();
  return ImGui::IsItemDeactivatedAfterEdit();
}

/// Every switch of the technique.
void edit_keys(SideChoice& choice) {
  const shadow::Spec& spec = *choice.spec;
  for (const shadow::SpecKey& key : spec.keys()) {
    const auto given = spec.values.find(key.name);
    std::string value = given == spec.values.end() ? key.default_value : given->second;
    const bool changed = edit_key(key, value, choice);
    tip(key.help + (key.default_value.empty() ? "" : fmt::format(" (default {})", key.default_value)));
    if (!changed) continue;
    shadow::Spec wanted = spec;
    wanted.values.erase(key.name);
    if (!value.empty() && value != key.default_value) wanted.values.emplace(key.name, value);
    choice.set(wanted.canonical());
    return;
  }
}

/// Half or twice the resolution.
void edit_resolution(SideChoice& choice) {
  if (choice.spec->resolution == 0) return;
  text(fmt::format("{} {}", choice.spec->resolution, choice.spec->storage.empty() ? "voxels" : "texels"));
  for (const bool finer : {false, true}) {
    ImGui::SameLine();
    if (!ImGui::SmallButton(finer ? "x 2" : "/ 2")) continue;
    shadow::Spec wanted = *choice.spec;
    wanted.resolution = finer ? wanted.resolution * 2 : wanted.resolution / 2;
    choice.set(wanted.canonical());
    return;
  }
}

void tell_figures(const SideFigures& figures) {
  if (!figures.problem.empty()) {
    colored(warning, figures.problem);
    return;
  }
  if (figures.stages.empty()) return;
  text(fmt::format("{:.1f} ms", figures.milliseconds) +
       (figures.bytes == 0 ? "" : fmt::format("   {:.1f} MB", static_cast<double>(figures.bytes) / 1e6)));
  tip("map and look-up of the last frame");
  if (figures.error) {
    text(fmt::format("wrong {:.3f} %   at edges {:.2f} %", 100 * figures.error->fraction,
                     100 * figures.error->boundary_fraction));
    tip("pixels facing the light whose shadow differs from ray tracing; the same within 3 pixels of a true edge");
    text(fmt::format("falsely dark {} (red), lit {} (blue)", figures.error->false_shadow, figures.error->false_lit));
  }
  if (!ImGui::TreeNode("stages")) return;
  for (const gpu::StageTime& stage : figures.stages)
    text(fmt::format("{:7.2f} ms  {}", stage.milliseconds, stage.name));
  ImGui::TreePop();
}

void edit_side(SideChoice& choice, const SideFigures& figures) {
  if (ImGui::BeginCombo("##alias", nullptr, ImGuiComboFlags_NoPreview)) {
    for (const shadow::SpecAlias& alias : shadow::spec_aliases())
      if (ImGui::Selectable(fmt::format("{:<5} {}", alias.name, alias.spec).c_str())) choice.set(alias.name);
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##spec", &choice.text);
  if (ImGui::IsItemDeactivatedAfterEdit()) choice.set(choice.text);
  tip("parameterization/storage/filter@resolution,key=value; Enter takes it");
  if (!choice.problem.empty()) colored(warning, choice.problem);
  if (!choice.spec) return;
  edit_resolution(choice);
  if (!choice.spec->keys().empty() && ImGui::TreeNode("switches")) {
    edit_keys(choice);
    ImGui::TreePop();
  }
  tell_figures(figures);
}

void edit_sides(State& state, const Told& told) {
  ImGui::PushID("left");
  edit_side(state.sides[left], told.sides[left]);
  ImGui::PopID();
  ImGui::Separator();
  if (ImGui::Checkbox("beside it", &state.compares) && state.compares && !state.sides[right].spec)
    state.sides[right].set("ray");
  tip("a second technique to the right of a line that can be dragged; 'ray' is the truth");
  if (!state.compares) return;
  ImGui::PushID("right");
  edit_side(state.sides[right], told.sides[right]);
  ImGui::PopID();
}

void edit_look(State& state, const Told& told) {
  int show = static_cast<int>(state.look.show);
  ImGui::BeginDisabled(!state.debug.empty());
  ImGui::RadioButton("lit", &show, static_cast<int>(Show::lit));
  ImGui::SameLine();
  ImGui::RadioButton("shadow", &show, static_cast<int>(Show::visibility));
  ImGui::SameLine();
  ImGui::RadioButton("wrong", &show, static_cast<int>(Show::wrong));
  tip("what differs from ray tracing: red is dark and should be lit, blue is lit and should be dark");
  state.look.show = static_cast<Show>(show);
  ImGui::EndDisabled();
  std::vector<std::string> names{""};
  names.insert(names.end(), told.debug_names.begin(), told.debug_names.end());
  choose("debug image", state.debug, names);
  tip("how the left technique works, in the picture's place");
}

void edit_camera(State& state, const Scene& scene) {
  if (!scene.cameras.empty())
    if (const auto chosen = choose_one("camera", state.camera.name, scene.cameras)) {
      state.camera = scene.cameras[*chosen];
      state.fov_y.reset();
      state.path.clear();
    }
  slider("metres a second", state.speed, 0.01, 10'000, "%.3g", ImGuiSliderFlags_Logarithmic);
  double fov = glm::degrees(state.camera.fov_y);
  if (slider("field of view", fov, 1, 160, "%.0f deg")) {
    state.fov_y = glm::radians(fov);
    state.camera.fov_y = *state.fov_y;
  }
}

void edit_light(State& state, const Scene& scene) {
  if (const auto chosen = choose_one("light", state.light.name, scene.lights, "a sun")) {
    state.light = *chosen < scene.lights.size() ? scene.lights[*chosen] : sun(state.sun.x, state.sun.y);
    if (state.light.kind == LightKind::directional) state.sun = sun_angles(state.light);
  }
  if (state.light.kind != LightKind::directional) return;
  bool turned = slider("azimuth", state.sun.x, -180, 360, "%.1f deg");
  turned |= slider("elevation", state.sun.y, -90, 90, "%.1f deg");
  if (turned) state.light.direction = sun(state.sun.x, state.sun.y).direction;
}

void edit_time(State& state, const Scene& scene) {
  if (!scene.paths.empty()) {
    std::vector<std::string> names{""};
    for (const CameraPath& path : scene.paths) names.push_back(path.name);
    if (choose("path", state.path, names)) {
      state.time = 0;
      state.plays = !state.path.empty();
      state.fov_y.reset();
    }
  }
  const double end = duration(scene, state.path);
  if (end <= 0) return;
  ImGui::Checkbox("play", &state.plays);
  tip("Space");
  ImGui::SameLine();
  slider("time", state.time, 0, end, "%.2f s");
}

void edit_picture(State& state, const Told& told) {
  text(fmt::format("{} x {}", told.picture.width, told.picture.height));
  for (const uint32_t coarseness : {1u, 2u, 4u}) {
    ImGui::SameLine();
    if (ImGui::RadioButton(fmt::format("1/{}", coarseness).c_str(), state.coarseness == coarseness))
      state.coarseness = coarseness;
    tip("pixels of the picture by pixels of the window, along each axis: fewer are quicker");
  }
  if (ImGui::Button("save picture")) state.save = true;
  tip("F12: a PNG in the current folder");
  ImGui::SameLine();
  if (ImGui::Button("copy command")) state.copy = true;
  tip("shadewright compare of what is shown, into the clipboard");
  if (!told.remark.empty()) colored(faint, told.remark);
}

}  // namespace

void draw_panel(State& state, const Told& told) {
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({24 * ImGui::GetFontSize(), ImGui::GetIO().DisplaySize.y - 20}, ImGuiCond_FirstUseEver);
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSizeConstraints({1, 1}, {std::max(1.0f, room.x), std::max(1.0f, room.y - 20)});
  ImGui::Begin("Shadewright", &state.panel);
  ImGui::PushItemWidth(-9 * ImGui::GetFontSize());
  text(told.scene->name);
  text(told.device);
  ImGui::Separator();
  edit_sides(state, told);
  ImGui::Separator();
  edit_look(state, told);
  ImGui::Separator();
  edit_camera(state, *told.scene);
  edit_light(state, *told.scene);
  edit_time(state, *told.scene);
  ImGui::Separator();
  text(fmt::format("camera pass {:.1f} ms", told.camera_milliseconds));
  edit_picture(state, told);
  ImGui::Separator();
  colored(faint,
          "Drag: look around. Right drag: circle. Wheel: nearer, farther. W A S D Q E: walk, Shift: faster. "
          "Space: play. Tab: these controls. F12: save. Escape: close.");
  ImGui::PopItemWidth();
  ImGui::End();
}

void draw_divider(State& state, const Told& told) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float reach = 0.5f * ImGui::GetFontSize();
  const float x = static_cast<float>(state.look.divider) * size.x;
  ImGui::SetNextWindowPos({x - reach, 0});
  ImGui::SetNextWindowSize({2 * reach, size.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("divider", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::InvisibleButton("line", {2 * reach, size.y});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive())
    state.look.divider = std::clamp(static_cast<double>(ImGui::GetIO().MousePos.x / size.x), 0.02, 0.98);
  ImGui::End();
  ImGui::PopStyleVar(2);

  ImDrawList& lines = *ImGui::GetBackgroundDrawList();
  lines.AddLine({x, 0}, {x, size.y}, IM_COL32(255, 255, 255, 200), 2);
  const float y = size.y - 2 * ImGui::GetFontSize();
  const auto name = [&](const std::string& label, float at) {
    const ImVec2 extent = ImGui::CalcTextSize(label.c_str());
    lines.AddRectFilled({at - 4, y - 3}, {at + extent.x + 4, y + extent.y + 3}, IM_COL32(0, 0, 0, 150), 3);
    lines.AddText({at, y}, IM_COL32_WHITE, label.c_str());
  };
  const auto label = [&](size_t side) {
    const std::string own = state.sides[side].spec ? state.sides[side].spec->text : "nothing";
    return told.sides[side].problem.empty() ? own : own + " (no answer)";
  };
  name(label(left), x - 12 - ImGui::CalcTextSize(label(left).c_str()).x);
  name(label(right), x + 12);
}

void draw_progress(const std::string& task, double fraction) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("progress", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  text(task);
  ImGui::ProgressBar(static_cast<float>(fraction), {20 * ImGui::GetFontSize(), 0});
  colored(faint, "Escape gives it up");
  ImGui::End();
}

}  // namespace shadewright::viewer
