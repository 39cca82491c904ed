// Turned chess pieces after the Staunton pattern, true size, each closed part standing on y = 0 and facing +X.
#pragma once

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

Mesh chess_pawn();
Mesh chess_rook();
Mesh chess_knight();
Mesh chess_bishop();
Mesh chess_queen();
Mesh chess_king();

}  // namespace shadewright::builtin
