// What either reader finds in a file is made fit for drawing here.
#include "scene/load_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "scene/file_options.h"
#include "scene/gltf/read_gltf.h"
#include "scene/read_assimp.h"
#include "scene/scene_graph.h"
#include "shadewright/error.h"

namespace shadewright {
namespace {

namespace fs = std::filesystem;

void check_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw InputError(path, "there is no such file", "check the path, or give builtin:NAME for a built-in scene");
  if (fs::is_directory(status)) throw InputError(path, "is a directory", "name a scene file in it");
  if (!fs::is_regular_file(status)) throw InputError(path, "is not a file that can be read", "name a scene file");
  if (fs::file_size(path, error) == 0 && !error) throw InputError(path, "is empty", "export or copy it again");
  if (!std::ifstream(path, std::ios::binary)) throw InputError(path, "cannot be opened", "check its permissions");
}

bool is_gltf(const std::string& path) {
  std::array<char, 4> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  const std::string extension = fs::path(path).extension().string();
  return std::string_view(magic.data(), magic.size()) == "glTF" || extension == ".gltf" || extension == ".glb" ||
         extension == ".GLTF" || extension == ".GLB";
}

/// Floats, and rays, have their limits: what lies within them is far beyond any scene in metres.
void check_reach(const std::string& path, const Scene& scene) {
  constexpr double farthest = 1e15;
  const auto check = [&](const std::string& what, const glm::dvec3& place) {
    const glm::dvec3 away = glm::abs(place);
    const double reach = std::max({away.x, away.y, away.z});
    if (!(reach < farthest))
      throw InputError(path, fmt::format("{} reaches {:.2g} metres from zero, beyond {:g}", what, reach, farthest),
                       "scale it down when you export it");
  };
  const Box box = bounds(scene);
  check("it", box.min);
  check("it", box.max);
  for (const Camera& camera : scene.cameras) check("camera \"" + camera.name + "\"", camera.eye);
  for (const Light& light : scene.lights) check("light \"" + light.name + "\"", light.position);
}

}  // namespace

LoadedScene load_file(const std::string& source, const Progress& progress) {
  const FileOptions options = parse_file_options(source);
  const std::string& path = options.path;
  check_file(path);
  LoadedScene loaded;
  SceneGraph graph =
      is_gltf(path) ? read_gltf(path, progress, loaded.warnings) : read_with_assimp(path, progress, loaded.warnings);
  for (Mesh& mesh : graph.meshes) {
    for (const glm::uvec3& triangle : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner)
        if (triangle[corner] >= mesh.positions.size())
          throw InputError(path, "has an index out of range in mesh \"" + mesh.name + "\"", "export the file again");
  }
  apply(options, graph);
  loaded.scene = flatten(std::move(graph), loaded.warnings);
  if (loaded.scene.name.empty()) loaded.scene.name = fs::path(path).stem().string();
  if (const size_t dropped = drop_degenerate_triangles(loaded.scene); dropped > 0)
    loaded.warnings.push_back(std::to_string(dropped) + " triangles without an area were left out.");
  if (triangle_count(loaded.scene) == 0) throw InputError(path, "has no triangles", "give a scene with meshes");
  recentre(loaded.scene);
  check_reach(path, loaded.scene);
  progress("load", 1.0);
  return loaded;
}

}  // namespace shadewright
