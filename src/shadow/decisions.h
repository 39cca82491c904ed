// How the receivers of a frame were decided, for storages whose look-up tells (`storage_decision` in its GLSL module):
// counters and a debug picture (SPSM figure 14). The frame's look-up itself does not tell, since counting took a tenth
// of its time: these ask every receiver once more.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

/// How many receivers there are of each decision; `names` of these from 1 on. `decisions` is a word a receiver, what
/// decisions_shader answers: how it was decided, from 1 on, plus shared::decided_lit where it is lit; 0 where there is
/// none.
Counters decision_counters(std::span<const uint32_t> decisions, std::span<const std::string> names);

/// Each receiver's colour: grey where its own texel decided, green where its neighbours, red where recovery did; bright
/// where lit.
Picture decisions_picture(std::span<const uint32_t> decisions, uint32_t width, uint32_t height);

}  // namespace shadewright::shadow
