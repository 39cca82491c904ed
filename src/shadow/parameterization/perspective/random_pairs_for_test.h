// Random cameras and lights around a scene: every case of PSM's figures 4 and 5, lamps inside and outside the scene.
#pragma once

#include <random>

#include "shadewright/scene/scene.h"

namespace shadewright::shadow {

class RandomPairs {
 public:
  RandomPairs(const Box& scene, unsigned seed) : scene_(scene), random_(seed) {}

  struct Pair {
    Camera camera;
    Light light;
  };
  Pair next() {
    Pair pair;
    const double size = 0.5 * scene_.diagonal();
    const glm::dvec3 center = scene_.center();
    pair.camera.eye = center + glm::dvec3(number(-1, 1), number(-0.1, 0.7), number(-1, 1)) * size;
    pair.camera.eye.y = std::max(pair.camera.eye.y, scene_.min.y + 0.02 * size);
    pair.camera.target = inside(0.6);
    pair.camera.fov_y = number(0.4, 1.4);
    pair.camera.near = 1e-4 * size;

    Light& light = pair.light;
    const int kind = static_cast<int>(number(0, 4));
    light.kind = kind < 2 ? LightKind::directional : kind == 2 ? LightKind::spot : LightKind::point;
    light.direction = direction();
    if (light.direction.y > 0 && number(0, 1) < 0.8) light.direction.y = -light.direction.y;
    const glm::dvec3 view = glm::normalize(pair.camera.target - pair.camera.eye);
    const double special = number(0, 1);
    if (special < 0.05) light.direction = view;
    if (special > 0.95) light.direction = -view;
    if (special > 0.45 && special < 0.5)  // parallel to the image plane
      light.direction = glm::normalize(glm::cross(view, direction()));
    if (light.kind == LightKind::directional) return pair;

    light.position = number(0, 1) < 0.5 ? inside(1) : center + direction() * (size * number(1, 3));
    light.position.y = std::max(light.position.y, scene_.min.y + 0.05 * size);
    if (special > 0.45 && special < 0.5)  // in the camera plane
      light.position = pair.camera.eye + 0.3 * size * glm::normalize(glm::cross(view, direction()));
    if (special < 0.05) light.position = pair.camera.eye;  // the camera's own lamp
    light.outer_angle = number(0.2, 1.2);
    if (light.kind == LightKind::spot && special > 0.05) light.direction = glm::normalize(inside(0.8) - light.position);
    return pair;
  }

 private:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 inside(double share) {
    return scene_.center() + 0.5 * share * glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)) * scene_.size();
  }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p(number(-1, 1), number(-1, 1), number(-1, 1));
      if (const double length = glm::length(p); length > 0.1 && length < 1) return p / length;
    }
  }

  Box scene_;
  std::mt19937 random_;
};

}  // namespace shadewright::shadow
