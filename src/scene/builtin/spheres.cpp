// Balls that float over a plane (the spheres of SPSM): smooth silhouettes at every distance from their shadows. All
// closed.
#include <cmath>

#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

BuiltinScene spheres() {
  BuiltinScene entry;
  entry.name = "spheres";
  entry.help = "balls floating over a plane, 12k triangles (SPSM)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "spheres";
    place(scene, "ground", slab({-9, -0.4, -9}, {9, 0, 9}, 0.05), color(0xB9B6AC));
    const uint32_t ball = add_mesh(scene, "ball", sphere(1.0, 20, 13));
    const uint32_t palette[] = {0xD9573F, 0xE8A33D, 0xE9D8A6, 0x4F9D8F, 0x3D6FA5, 0x8A5A83, 0xC9C5BA};
    Random random(12);
    constexpr int rows = 5;
    for (int i = 0; i < rows * rows; ++i) {
      const double radius = 0.25 + 0.5 * random.unit() * random.unit();
      const double x = 2.9 * (i % rows - 2) + random.range(-0.7, 0.7),
                   z = 2.9 * (i / rows - 2.0) + random.range(-0.7, 0.7);
      // One in five lies on the ground, the others float.
      const double y = i % 5 == 2 ? radius - 0.004 : radius + 0.15 + 2.6 * random.unit() * random.unit();
      place(scene, "ball", ball, color(palette[random.index(7)]),
            moved({x, y, z}) * turned_y(random.angle()) * turned_z(random.angle()) * scaled(glm::dvec3(radius)));
    }
    add_camera(scene, "main", {3.6, 4.0, 11.0}, {0.0, 0.5, -0.6}, 45);
    add_camera(scene, "near", {1.6, 0.9, 6.3}, {-0.6, 0.5, 0.5}, 50);
    add_sun(scene, 150, 48);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
