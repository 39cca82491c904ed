#include "viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "baker.h"
#include "camera_moves.h"
#include "gui.h"
#include "panel.h"
#include "shadewright/error.h"
#include "shadewright/scene/moments.h"

namespace shadewright::viewer {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double idle_wait = 0.25;    // seconds between frames while nobody does anything
constexpr double longest_step = 0.5;  // seconds that a camera moves in one frame, at most

/// Thrown out of long work when the window is closed.
struct Closed {};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The first of shadewright-0001.png, ... that is not there yet.
std::filesystem::path free_name() {
  std::error_code ignored;
  for (int i = 1;; ++i)
    if (const std::string name = fmt::format("shadewright-{:04}.png", i); !std::filesystem::exists(name, ignored))
      return name;
}

class Session {
 public:
  Session(Window& window, const gpu::Device& device, const Scene& scene, const Start& start);
  void run();

 private:
  void take_input(double seconds);
  void draw_controls();
  void press_keys(std::span<const int> keys);
  bool steer(double seconds);
  void draw();
  void choose_techniques();
  void choose_size();
  void choose_debug_image(bool redrawn);
  void run_commands();
  void tell();
  void present();
  bool watch_bake(const std::string& task, double fraction);

  Window& window_;
  const gpu::Device& device_;
  const Scene& scene_;
  const double extent_;  ///< the scene's diagonal, metres
  Gui gui_;
  Baker baker_;
  Canvas canvas_;
  State state_;
  Told told_;
  std::array<std::string, 2> chosen_;  ///< the specs that the canvas has
  vk::Extent2D size_, wanted_size_;
  std::string shown_debug_;
  Picture debug_picture_;
  gpu::Image debug_;         ///< the same on the device; none while the canvas' picture is shown
  bool restless_ = true;     ///< the next frame does not wait
  bool in_between_ = false;  ///< a bake has shown the controls in this frame's place
};

Session::Session(Window& window, const gpu::Device& device, const Scene& scene, const Start& start)
    : window_(window),
      device_(device),
      scene_(scene),
      extent_(bounds(scene).diagonal()),
      gui_(window, device),
      baker_([this](const std::string& task, double fraction) { return watch_bake(task, fraction); }),
      canvas_(device, scene,
              [this](const Scene& baked, const Light& light, const voxel::BakeOptions& options, const Progress&) {
                return baker_(baked, light, options);
              }) {
  state_.camera = start.camera;
  state_.fov_y = start.fov_y;
  state_.speed = 0.1 * glm::distance(start.camera.eye, start.camera.target);
  state_.light = start.light;
  if (start.light.kind == LightKind::directional) state_.sun = sun_angles(start.light);
  state_.path = start.path;
  state_.plays = !start.path.empty();
  state_.debug = start.debug;
  for (size_t side = 0; side < start.specs.size(); ++side) state_.sides[side] = SideChoice(start.specs[side]);
  state_.compares = start.specs.size() > 1;
  state_.look.divider = 0.5;
  if (device.is_cpu()) state_.coarseness = 2;
  told_.scene = &scene;
  told_.scene_source = start.scene_source;
  told_.device = device.info().name;
}

void Session::run() {
  Clock::time_point last = Clock::now();
  while (!window_.is_closing() && !state_.quit) {
    const bool minimized = window_.size().width == 0;
    window_.take_events(restless_ && !minimized ? 0 : idle_wait);
    const double step = std::min(seconds_since(last), longest_step);
    last = Clock::now();
    restless_ = in_between_ = false;
    take_input(step);
    draw();
    restless_ |= in_between_;
    if (!in_between_) present();
  }
}

void Session::take_input(double seconds) {
  const std::vector<int> keys = window_.take_pressed_keys();
  gui_.begin(keys);
  draw_controls();
  press_keys(keys);
  restless_ |= steer(seconds);  // before the end of ImGui's frame, which forgets the wheel
  gui_.end();
}

void Session::draw_controls() {
  if (state_.compares && !debug_) draw_divider(state_, told_);
  if (state_.panel) draw_panel(state_, told_);
}

void Session::press_keys(std::span<const int> keys) {
  const bool typing = ImGui::GetIO().WantTextInput;
  for (const int key : keys) {
    if (typing) continue;
    if (key == GLFW_KEY_TAB) state_.panel = !state_.panel;
    if (key == GLFW_KEY_SPACE) state_.plays = !state_.plays;
    if (key == GLFW_KEY_F12) state_.save = true;
    if (key == GLFW_KEY_ESCAPE && !gui_.close_lists()) state_.quit = true;
  }
}

/// Moves time and camera by what runs, is held and is dragged; true while something does.
bool Session::steer(double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  const double end = duration(scene_, state_.path);
  const bool runs = state_.plays && end > 0;
  if (runs) state_.time = std::fmod(state_.time + seconds, end);

  Camera camera = state_.camera;
  bool steered = false;
  const auto take = [&](const Camera& other) {
    camera = other;
    steered = true;
  };
  if (!io.WantTextInput && !io.KeyCtrl) {
    const auto held = [](int key) { return ImGui::IsKeyDown(key) ? 1.0 : 0.0; };
    const glm::dvec3 axes(held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q),
                          held(GLFW_KEY_W) - held(GLFW_KEY_S));
    if (axes != glm::dvec3(0.0)) take(moved(camera, axes * state_.speed * seconds * (io.KeyShift ? 5.0 : 1.0)));
  }
  if (!io.WantCaptureMouse && io.DisplaySize.y > 0) {
    const glm::dvec2 drag =
        glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) * camera.fov_y / static_cast<double>(io.DisplaySize.y);
    const bool drags = drag != glm::dvec2(0.0);
    if (drags && io.MouseDown[ImGuiMouseButton_Left]) take(turned(camera, drag.x, -drag.y));
    if (drags && io.MouseDown[ImGuiMouseButton_Right]) take(circled(camera, 3 * drag.x, -3 * drag.y));
    if (io.MouseWheel != 0)
      take(approached(camera, std::pow(0.85, static_cast<double>(io.MouseWheel)), 1e-4 * extent_, 100 * extent_));
  }
  if (steered) {
    camera.name = "here";
    state_.camera = camera;
    state_.path.clear();
  } else if (!state_.path.empty()) {
    state_.camera = camera_at(find_path(scene_, state_.path), state_.time);
    state_.camera.fov_y = state_.fov_y.value_or(state_.camera.fov_y);
  }
  return runs || steered;
}

void Session::draw() {
  try {
    choose_size();
    choose_techniques();
    if (size_.width == 0) return;
    // Once nothing moves any more, a first frame's times are replaced by a warm one's.
    if (!restless_ && canvas_.has_cold_figures()) canvas_.forget_cold_figures();
    Look look = state_.look;
    if (!state_.compares) look.divider = 1;
    const bool redrawn = canvas_.draw({state_.time, state_.camera, state_.light}, look);
    restless_ |= redrawn;
    if (redrawn && !canvas_.has_cold_figures()) told_.remark.clear();
    tell();
    choose_debug_image(redrawn);
    run_commands();
  } catch (const Closed&) {
  }
}

void Session::choose_size() {
  const vk::Extent2D window = window_.size();
  const vk::Extent2D wanted{std::max(1u, window.width / state_.coarseness),
                            std::max(1u, window.height / state_.coarseness)};
  if (window.width == 0 || wanted == size_) return;
  // While an edge is dragged the old picture is stretched: everything of the picture's size is made anew.
  const bool rests = wanted == wanted_size_;
  wanted_size_ = wanted;
  restless_ = true;
  if (!rests && size_.width != 0) return;
  size_ = wanted;
  canvas_.resize(wanted.width, wanted.height);
}

void Session::choose_techniques() {
  for (const size_t side : {left, right}) {
    const bool shown = side == left || state_.compares;
    const std::optional<shadow::Spec> spec = shown ? state_.sides[side].spec : std::nullopt;
    const std::string name = spec ? spec->canonical() : "";
    if (name == chosen_[side]) continue;
    chosen_[side] = name;
    canvas_.set_technique(side, spec);
  }
}

void Session::choose_debug_image(bool redrawn) {
  if (std::ranges::find(told_.debug_names, state_.debug) == told_.debug_names.end()) state_.debug.clear();
  if (state_.debug == shown_debug_ && !redrawn) return;
  shown_debug_ = state_.debug;
  debug_ = {};
  if (state_.debug.empty() || !told_.sides[left].problem.empty()) return;
  try {
    debug_picture_ = canvas_.debug_picture(left, state_.debug);
    using Usage = vk::ImageUsageFlagBits;
    gpu::Image image(device_, {"debug image", vk::Format::eR8G8B8A8Unorm, debug_picture_.width, debug_picture_.height,
                               1, Usage::eSampled | Usage::eTransferDst | Usage::eTransferSrc});
    gpu::upload(device_, image, std::as_bytes(std::span(debug_picture_.pixels)));
    gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
      image.transition(commands, vk::ImageLayout::eTransferSrcOptimal);
    });
    debug_ = std::move(image);
  } catch (const Error& error) {
    told_.remark = error.what();
    state_.debug.clear();
    shown_debug_.clear();
  }
}

void Session::run_commands() {
  if (state_.save) {
    const std::filesystem::path file = free_name();
    try {
      write_png(debug_ ? debug_picture_ : canvas_.picture(), file);
      told_.remark = "saved " + file.string();
    } catch (const Error& error) {
      told_.remark = error.what();
    }
  }
  if (state_.copy) {
    const std::string command = compare_command(state_, told_);
    window_.set_clipboard(command);
    const bool moves = state_.time > 0 && !scene_.motions.empty();
    told_.remark = std::string(moves ? "Copied; it shows moving things where they begin:\n" : "Copied:\n") + command;
  }
  restless_ |= state_.save || state_.copy;
  state_.save = state_.copy = false;
}

void Session::tell() {
  told_.picture = size_;
  told_.camera_milliseconds = canvas_.camera_milliseconds();
  for (const size_t side : {left, right}) told_.sides[side] = canvas_.figures(side);
  told_.debug_names = canvas_.debug_names(left);
}

void Session::present() {
  window_.present(debug_ ? debug_ : canvas_.image(), [&](const auto& commands, vk::ImageView view, vk::Extent2D size) {
    gui_.record(commands, view, size);
  });
}

/// A frame of the window while a bake runs: the controls live on, what they change comes afterwards. Escape gives up.
bool Session::watch_bake(const std::string& task, double fraction) {
  in_between_ = true;
  window_.take_events(0);
  if (window_.is_closing()) throw Closed{};
  const std::vector<int> keys = window_.take_pressed_keys();
  gui_.begin(keys);
  draw_controls();
  draw_progress(task, fraction);
  gui_.end();
  present();
  return std::ranges::find(keys, GLFW_KEY_ESCAPE) == keys.end();
}

}  // namespace

void run(Window& window, const gpu::Device& device, const Scene& scene, const Start& start) {
  Session(window, device, scene, start).run();
}

}  // namespace shadewright::viewer
