// The controls beside the picture: every choice there is, and what the choices cost.
#pragma once

#include "state.h"

namespace shadewright::viewer {

/// Draws the controls with ImGui, between the begin and the end of a frame, and changes what a person changes.
void draw_panel(State& state, const Told& told);

/// The line between the two sides, which can be dragged, and their names beside it.
void draw_divider(State& state, const Told& told);

/// What takes long, in the window's middle; Escape gives it up.
void draw_progress(const std::string& task, double fraction);

}  // namespace shadewright::viewer
