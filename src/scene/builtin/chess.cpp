// A chess board in mid-game under a lamp, for the low camera and spot light of PSM's figure 1. Everything is closed.
#include <array>
#include <numbers>
#include <string_view>

#include "scene/builtin/chess_pieces.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr double square = 0.055;  // metres

/// Rank 8 first, as a diagram shows it: capitals are white.
constexpr std::array<std::string_view, 8> position = {
    "r..q.rk.",  //
    "pb...ppp",  //
    ".p..pn..",  //
    "...N....",  //
    "..BP.n..",  //
    "P...PN..",  //
    ".P...PPP",  //
    "R..Q.RK.",
};

/// Where a square's centre is: file a..h along +X, rank 8 away at -Z.
glm::dvec3 center_of(size_t file, size_t row) {
  return {(double(file) - 3.5) * square, 0, (double(row) - 3.5) * square};
}

void add_board(Scene& scene) {
  // The squares are tiles with a hair's gap, let into a frame that stands a millimetre above them.
  const double half = 0.5 * square - 0.0003;
  const uint32_t tile = add_mesh(scene, "tile", slab({-half, -0.004, -half}, {half, 0, half}, 0.0004));
  for (size_t row = 0; row < 8; ++row)
    for (size_t file = 0; file < 8; ++file)
      place(scene, "tile", tile, color((row + file) % 2 == 0 ? 0xE2CBA0 : 0x8A5A3A), moved(center_of(file, row)));

  const double inner = 4 * square + 0.0006, outer = inner + 0.032, diagonal = std::numbers::sqrt2;
  const Profile frame = {{outer * diagonal, -0.021},           {outer * diagonal, -0.003},
                         {(outer - 0.003) * diagonal, 0.0005}, {(inner + 0.004) * diagonal, 0.0015},
                         {inner * diagonal, 0.0008},           {inner * diagonal, -0.021}};
  place(scene, "frame", transformed(lathe_ring(frame, 4), turned_y(std::numbers::pi / 4)), color(0x6B4026));
  place(scene, "bed", box({-inner - 0.01, -0.019, -inner - 0.01}, {inner + 0.01, -0.003, inner + 0.01}),
        color(0x2E1C12));
  const Profile table = {{0.66, -0.06}, {0.70, -0.052}, {0.705, -0.036}, {0.70, -0.023}, {0.692, -0.02}, {0, -0.02}};
  place(scene, "table", lathe(table, 72), color(0x7D8F6A));
}

}  // namespace

BuiltinScene chess() {
  BuiltinScene entry;
  entry.name = "chess";
  entry.help = "a chess game under a spot light, seen from low above the board (PSM fig. 1)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "chess";
    add_board(scene);

    constexpr std::string_view kinds = "prnbqk";
    const std::array<uint32_t, 6> meshes = {
        add_mesh(scene, "pawn", chess_pawn()),     add_mesh(scene, "rook", chess_rook()),
        add_mesh(scene, "knight", chess_knight()), add_mesh(scene, "bishop", chess_bishop()),
        add_mesh(scene, "queen", chess_queen()),   add_mesh(scene, "king", chess_king())};
    const glm::vec3 white = color(0xEBDDBE), black = color(0x5A3A2A);
    const auto set = [&](char letter, const glm::dmat4& where) {
      const bool is_white = letter >= 'A' && letter <= 'Z';
      const size_t kind = kinds.find(is_white ? static_cast<char>(letter - 'A' + 'a') : letter);
      // Pieces face the other side; they sink a tenth of a millimetre into the board.
      const double facing = is_white ? std::numbers::pi / 2 : -std::numbers::pi / 2;
      place(scene, scene.meshes[meshes[kind]].name, meshes[kind], is_white ? white : black,
            where * moved({0, -0.0001, 0}) * turned_y(facing));
    };
    for (size_t row = 0; row < 8; ++row)
      for (size_t file = 0; file < 8; ++file)
        if (position[row][file] != '.') set(position[row][file], moved(center_of(file, row)));

    add_camera(scene, "low", {0.15, 0.105, 0.34}, {-0.015, 0.012, -0.01}, 45);
    add_camera(scene, "above", {-0.32, 0.5, 0.5}, {0, 0, 0.02}, 42);
    add_spot(scene, "lamp", {-0.5, 0.4, -0.16}, {0.0, 0.0, 0.0}, 34);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
