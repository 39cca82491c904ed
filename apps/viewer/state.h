// What a person has chosen in the window, and what the window tells about the frame that it shows.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "canvas.h"
#include "shadewright/scene/scene.h"
#include "shadewright/shadow/spec.h"

namespace shadewright::viewer {

/// The technique of one side, as it is typed or chosen.
struct SideChoice {
  std::string text;
  std::optional<shadow::Spec> spec;      ///< the last text that was one
  std::string problem;                   ///< what is wrong with the text, one sentence; empty = nothing
  std::string edited_key, edited_value;  ///< the switch that is being typed into, and what it says so far

  SideChoice() = default;
  explicit SideChoice(const shadow::Spec& chosen) : text(chosen.text), spec(chosen) {}
  /// Takes `wanted` for the text, and for the spec if it is one.
  void set(const std::string& wanted);
};

struct State {
  std::array<SideChoice, 2> sides;
  bool compares = false;  ///< the right side is shown
  Look look;
  std::string debug;  ///< a debug image of the left side's that takes the place of the picture; empty: none

  Camera camera;
  std::optional<double> fov_y;  ///< full vertical angle, radians, whatever a path says; none: as the path says
  double speed = 1;             ///< metres a second
  Light light;
  glm::dvec2 sun{35, 45};   ///< azimuth and elevation in degrees, where the light is a sun
  double time = 0;          ///< seconds
  bool plays = false;       ///< time runs
  std::string path;         ///< the camera path that is followed; empty: none
  uint32_t coarseness = 1;  ///< pixels of the window that a pixel of the picture covers, along each axis
  bool panel = true;        ///< the controls are shown

  // What is to be done once.
  bool save = false, copy = false, quit = false;
};

/// What the panel shows beside the choices.
struct Told {
  const Scene* scene = nullptr;
  std::string scene_source;  ///< as it is named on the command line
  std::string device;
  vk::Extent2D picture;  ///< pixels
  double camera_milliseconds = 0;
  std::array<SideFigures, 2> sides;
  std::vector<std::string> debug_names;  ///< the left side's
  std::string remark;                    ///< what the last command did
};

/// The seconds that time runs through before it begins anew: the path's, or the scene's motions'; 0 where nothing
/// moves.
double duration(const Scene& scene, const std::string& path);

/// The command that makes a report of what is shown.
std::string compare_command(const State& state, const Told& told);

}  // namespace shadewright::viewer
