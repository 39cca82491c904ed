// What the window shows, without the window: a scene on the device, drawn by the camera, with the answers of up to two
// techniques side by side.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compose.h"
#include "shadewright/compare/report.h"
#include "shadewright/gpu/pass.h"
#include "shadewright/image/picture.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/render/scene_gpu.h"
#include "shadewright/scene/moments.h"
#include "shadewright/shadow/technique.h"
#include "truth.h"

namespace shadewright::viewer {

enum class Show : uint32_t { lit = shared::show_lit, visibility = shared::show_visibility, wrong = shared::show_wrong };

/// How the answers are laid out.
struct Look {
  Show show = Show::lit;
  double divider = 1;  ///< share of the width that is the left side's

  bool operator==(const Look&) const = default;
};

inline constexpr size_t left = 0, right = 1;

/// What a side's technique took in the frame that was drawn last.
struct SideFigures {
  std::string problem;  ///< why there is no answer, one sentence; empty = there is one
  std::vector<gpu::StageTime> stages;
  double milliseconds = 0;  ///< of all of them
  uint64_t bytes = 0;
  std::optional<compare::ErrorFigures> error;  ///< while wrong pixels are shown
};

class Canvas {
 public:
  /// `scene` outlives the canvas. `bake` bakes what techniques ask for (null: voxel::bake).
  Canvas(const gpu::Device& device, const Scene& scene, shadow::BakeShadow bake = {});

  /// Makes everything that has the picture's size anew, the techniques included. The picture is empty until `draw`.
  void resize(uint32_t width, uint32_t height);
  /// Which technique answers on `side`; none: nobody.
  void set_technique(size_t side, const std::optional<shadow::Spec>& spec);
  /// Draws the moment; what has not changed since the last call (the camera's pass, a side's answer, the truth, all)
  /// stays as it is. True if anything was drawn.
  bool draw(const Moment& moment, const Look& look);
  /// Whether a side's figures are of its technique's first frame, which compiles shaders.
  bool has_cold_figures() const;
  /// Lets the next `draw` take those again.
  void forget_cold_figures();

  /// RGBA8, sRGB, in transfer-source layout.
  gpu::Image& image() { return image_; }
  /// The same, read back.
  Picture picture();
  double camera_milliseconds() const { return camera_milliseconds_; }
  const SideFigures& figures(size_t side) const { return sides_[side].figures; }
  /// A side's debug images: their names, and one of the frame that was drawn last.
  std::vector<std::string> debug_names(size_t side) const;
  Picture debug_picture(size_t side, const std::string& name);

 private:
  /// One technique, or the truth in its place (`ray`), or nobody.
  struct Side {
    std::optional<shadow::Spec> spec;
    std::unique_ptr<shadow::Technique> technique;
    std::optional<Light> checked;  ///< the light that the technique is known to serve, or not to (figures.problem)
    SideFigures figures;
    bool answered = false;  ///< for what is drawn
    int frames = 0;         ///< that the technique has drawn

    bool is_truth() const { return spec && spec->parameterization == "ray"; }
    bool has_answer() const { return is_truth() || (technique && figures.problem.empty()); }
  };

  void make_technique(Side& side);
  void draw_camera(const Moment& moment);
  void answer(Side& side);
  void trace();
  void measure(Side& side);
  void compose(const Look& look);
  gpu::Image& visibility(const Side& side);

  const gpu::Device& device_;
  const Scene& scene_;
  shadow::BakeShadow bake_;
  render::SceneGpu scene_gpu_;
  gpu::GraphicsPass compose_;
  vk::raii::Sampler sampler_;
  gpu::Buffer camera_;

  std::unique_ptr<render::CameraPass> camera_pass_;
  std::unique_ptr<Truth> truth_;  ///< made when it is first wanted
  std::array<Side, 2> sides_;
  gpu::Image image_;
  std::optional<Moment> drawn_;   ///< what the camera pass shows
  std::optional<Look> composed_;  ///< how the picture shows it; none: it is not what it should be
  bool traced_ = false;           ///< the truth is of that
  render::CameraView view_;
  double lamp_distance_ = 0;  ///< see render::lamp_distance: of the camera that the light was first seen by
  double camera_milliseconds_ = 0;
};

}  // namespace shadewright::viewer
