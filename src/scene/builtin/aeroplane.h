// A light aeroplane with two wings one above the other, struts and wires. Every part is closed.
#pragma once

#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// Flies along +X, 7 m long, 8.6 m span; its middle is at the origin. The wings take the dye.
Prop aeroplane(Scene& scene);

}  // namespace shadewright::builtin
