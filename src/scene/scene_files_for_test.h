// What the tests of loading and writing share: a folder that goes away, a scene with one of everything, GLBs by hand.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "base/temporary_folder_for_test.h"
#include "shadewright/error.h"
#include "shadewright/scene/scene.h"

namespace shadewright {

inline std::string read_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string word(size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

/// A GLB of this JSON text and binary chunk.
inline std::string make_glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

/// glTF JSON of one triangle under one node; its 36 bytes of positions are followed by three 16-bit indices.
inline nlohmann::json triangle_gltf() {
  return nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "node", "mesh": 0}],
    "meshes": [{"name": "triangle", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 42}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})");
}

inline std::string triangle_bytes(const std::array<float, 9>& positions = {0, 0, 0, 1, 0, 0, 0, 0, 1},
                                  const std::array<uint16_t, 3>& indices = {0, 1, 2}) {
  return std::string(reinterpret_cast<const char*>(positions.data()), 36) +
         std::string(reinterpret_cast<const char*>(indices.data()), 6);
}

/// One of everything that a Scene can hold.
inline Scene full_scene() {
  Scene scene;
  scene.name = "everything";
  Mesh square{"square", {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}};
  Mesh tetrahedron{
      "tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  scene.meshes = {square, tetrahedron};
  Motion motion;
  motion.name = "swing";
  motion.times = {0.0, 0.5, 2.0};
  motion.translations = {{1, 2, 3}, {2, 2, 3}, {-1, 0, 5}};
  for (const double angle : {0.1, 1.3, 2.9})
    motion.rotations.push_back(glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 2, -1))));
  scene.motions = {motion};
  for (int i = 0; i < 6; ++i) {
    Instance instance;
    instance.name = "instance " + std::to_string(i);
    instance.mesh = static_cast<uint32_t>(i % 2);
    instance.world_from_mesh = glm::rotate(glm::translate(glm::dmat4(1.0), {3.3 * i, 0.1, -i}), 0.7 * i, {0, 1, 0}) *
                               glm::scale(glm::dmat4(1.0), {1.0, 2.0, i == 3 ? -1.0 : 1.0});
    instance.albedo = i < 3 ? glm::vec3(0.25f, 0.5f, 0.75f) : glm::vec3(0.1f);
    if (i >= 4) instance.motion = 0;
    scene.instances.push_back(instance);
  }
  Camera level, rolled;
  level.name = "level";
  level.eye = {1, 2, 30};
  level.target = {4, 1, 3};
  level.fov_y = 0.8;
  rolled = level;
  rolled.name = "rolled";
  rolled.up = glm::normalize(glm::dvec3(1, 1, 0));
  rolled.near = 0.25;
  scene.cameras = {level, rolled};
  Light spot{"spot", LightKind::spot, {5, 9, 5}, glm::normalize(glm::dvec3(-1, -2, 0.5)), 0.4};
  Light point{"point", LightKind::point, {1, 7, 2}, {0, -1, 0}, glm::radians(30.0)};
  scene.lights = {sun(35, 45), spot, point};
  CameraPath path{"flight", {0.0, 1.5, 4.0}, {level, rolled, level}};
  for (Camera& key : path.keys) key.name = path.name;
  path.keys[2].eye.x = 77;
  scene.paths = {path};
  return scene;
}

/// What an InputError of `action` says; the test fails without one.
std::string input_error(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

}  // namespace shadewright
