#include "scene/read_assimp.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>

#include "shadewright/error.h"

namespace shadewright {
namespace {

glm::dvec3 to_vec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// assimp's matrices are row-major.
glm::dmat4 to_matrix(const aiMatrix4x4& m) {
  glm::dmat4 result;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      result[static_cast<int>(column)][static_cast<int>(row)] = static_cast<double>(m[row][column]);
  return result;
}

/// IEC 61966-2-1.
float linear_from_srgb(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

bool is_z_up_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".blend" || extension == ".3mf";
}

/// Passes assimp's progress on. An exception of the sink must not unwind through assimp, which would take it for a
/// damaged file: it is kept for later.
class ProgressBridge : public Assimp::ProgressHandler {
 public:
  ProgressBridge(const Progress& progress, std::exception_ptr& cancelled)
      : progress_(progress), cancelled_(cancelled) {}

  bool Update(float fraction) override {
    if (cancelled_) return false;
    try {
      if (fraction >= 0.0f) progress_("load", 0.9 * std::clamp(static_cast<double>(fraction), 0.0, 1.0));
    } catch (...) {
      cancelled_ = std::current_exception();
    }
    return !cancelled_;
  }

 private:
  const Progress& progress_;
  std::exception_ptr& cancelled_;
};

class Converter {
 public:
  Converter(const aiScene& source, std::vector<std::string>& warnings) : source_(source), warnings_(warnings) {}

  SceneGraph convert(bool format_is_z_up) {
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) add_mesh(*source_.mMeshes[i]);
    if (source_.mRootNode) add_node(*source_.mRootNode, std::nullopt);
    for (unsigned i = 0; i < source_.mNumCameras; ++i) add_camera(*source_.mCameras[i]);
    for (unsigned i = 0; i < source_.mNumLights; ++i) add_light(*source_.mLights[i]);
    for (unsigned i = 0; i < source_.mNumAnimations; ++i) add_animation(*source_.mAnimations[i]);
    turn_up(format_is_z_up);
    add_warnings();
    return std::move(graph_);
  }

 private:
  void add_mesh(const aiMesh& source) {
    Mesh mesh;
    mesh.name = source.mName.C_Str();
    for (unsigned i = 0; i < source.mNumVertices; ++i) mesh.positions.emplace_back(to_vec3(source.mVertices[i]));
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices == 3)
        mesh.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      else
        ++points_and_lines_;
    }
    has_skins_ |= source.HasBones();
    graph_.meshes.push_back(std::move(mesh));
  }

  glm::vec3 albedo(unsigned material_index) {
    if (material_index >= source_.mNumMaterials) return GraphPart{}.albedo;
    const aiMaterial& material = *source_.mMaterials[material_index];
    float opacity = 1.0f;
    if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) has_transparency_ |= opacity < 1.0f;
    has_transparency_ |= material.GetTextureCount(aiTextureType_OPACITY) > 0;
    aiColor3D color;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS) return GraphPart{}.albedo;
    return {linear_from_srgb(color.r), linear_from_srgb(color.g), linear_from_srgb(color.b)};
  }

  void add_node(const aiNode& source, std::optional<uint32_t> parent) {
    const auto index = static_cast<uint32_t>(graph_.nodes.size());
    GraphNode node;
    node.name = source.mName.C_Str();
    node.parent = parent;
    node.parent_from_node = to_matrix(source.mTransformation);
    for (unsigned i = 0; i < source.mNumMeshes; ++i)
      node.parts.push_back({source.mMeshes[i], albedo(source_.mMeshes[source.mMeshes[i]]->mMaterialIndex)});
    node_by_name_.try_emplace(node.name, index);
    graph_.nodes.push_back(std::move(node));
    for (unsigned i = 0; i < source.mNumChildren; ++i) add_node(*source.mChildren[i], index);
  }

  /// assimp ties cameras, lights and channels to nodes by name.
  GraphNode* find_node(const aiString& name) {
    const auto found = node_by_name_.find(name.C_Str());
    return found == node_by_name_.end() ? nullptr : &graph_.nodes[found->second];
  }

  void add_camera(const aiCamera& source) {
    GraphNode* node = find_node(source.mName);
    if (!node || node->camera) return;
    GraphCamera camera;
    camera.camera.name = source.mName.C_Str();
    camera.camera.eye = to_vec3(source.mPosition);
    camera.camera.target = camera.camera.eye + to_vec3(source.mLookAt);
    camera.camera.up = to_vec3(source.mUp);
    // The file's is the whole horizontal angle; without an aspect ratio take that of the default image.
    const double aspect = source.mAspect > 0.0f ? static_cast<double>(source.mAspect) : 16.0 / 9.0;
    const double fov_y = 2.0 * std::atan(std::tan(0.5 * static_cast<double>(source.mHorizontalFOV)) / aspect);
    if (fov_y > 0 && fov_y < glm::radians(179.0)) camera.camera.fov_y = fov_y;
    if (!(glm::length(to_vec3(source.mLookAt)) > 0) || !(glm::length(camera.camera.up) > 0)) return;
    node->camera = camera;
  }

  void add_light(const aiLight& source) {
    GraphNode* node = find_node(source.mName);
    if (!node || node->light) return;
    Light light;
    light.name = source.mName.C_Str();
    light.position = to_vec3(source.mPosition);
    if (source.mType == aiLightSource_POINT)
      light.kind = LightKind::point;
    else if (source.mType == aiLightSource_SPOT)
      light.kind = LightKind::spot;
    else if (source.mType != aiLightSource_DIRECTIONAL)
      return;
    if (const glm::dvec3 direction = to_vec3(source.mDirection); glm::length(direction) > 0)
      light.direction = glm::normalize(direction);
    // assimp's is the whole angle of the cone.
    light.outer_angle =
        std::clamp(0.5 * static_cast<double>(source.mAngleOuterCone), glm::radians(0.1), glm::radians(89.9));
    node->light = light;
  }

  void add_animation(const aiAnimation& source) {
    const double ticks_per_second = source.mTicksPerSecond > 0 ? source.mTicksPerSecond : 25.0;
    for (unsigned i = 0; i < source.mNumChannels; ++i) {
      const aiNodeAnim& channel = *source.mChannels[i];
      GraphNode* node = find_node(channel.mNodeName);
      if (!node) continue;
      if (node->is_animated()) {
        has_more_animations_ = true;
        continue;
      }
      aiVector3D scale, translation;
      aiQuaternion rotation;
      aiMatrix4x4 rest = find_source_transform(channel.mNodeName);
      rest.Decompose(scale, rotation, translation);
      node->rest_scale = to_vec3(scale);
      node->rest_translation = to_vec3(translation);
      node->rest_rotation = unit(rotation);
      read_keys(node->translations, channel.mPositionKeys, channel.mNumPositionKeys, ticks_per_second, to_vec3);
      read_keys(node->scales, channel.mScalingKeys, channel.mNumScalingKeys, ticks_per_second, to_vec3);
      read_keys(node->rotations, channel.mRotationKeys, channel.mNumRotationKeys, ticks_per_second, unit);
    }
  }

  aiMatrix4x4 find_source_transform(const aiString& name) const {
    const aiNode* node = source_.mRootNode->FindNode(name);
    return node ? node->mTransformation : aiMatrix4x4();
  }

  static glm::dquat unit(const aiQuaternion& q) {
    const glm::dquat result(q.w, q.x, q.y, q.z);
    const double length = glm::length(result);
    return length > 0 && std::isfinite(length) ? result / length : glm::dquat(1, 0, 0, 0);
  }

  /// Keys that do not ascend are skipped: some writers repeat the first or the last.
  template <typename Value, typename Key, typename Convert>
  static void read_keys(Track<Value>& track, const Key* keys, unsigned count, double ticks_per_second,
                        const Convert& convert) {
    for (unsigned i = 0; i < count; ++i) {
      const double time = keys[i].mTime / ticks_per_second;
      if (!std::isfinite(time) || (!track.times.empty() && !(time > track.times.back()))) continue;
      track.times.push_back(time);
      track.values.push_back(convert(keys[i].mValue));
    }
  }

  /// assimp 5.2.5 itself turns COLLADA, 3DS, ASE and IFC. FBX says in its metadata which axis is up and leaves the turn
  /// to us; Blender and 3MF are Z-up and say nothing. Other formats (OBJ, STL, PLY, AC3D) are taken as they are.
  void turn_up(bool format_is_z_up) {
    int32_t axis = format_is_z_up ? 2 : 1, sign = 1;
    if (source_.mMetaData && source_.mMetaData->Get("UpAxis", axis)) source_.mMetaData->Get("UpAxisSign", sign);
    if (graph_.nodes.empty() || axis < 0 || axis > 2 || (axis == 1 && sign >= 0)) return;
    // Turn about the axis that carries up to +Y the short way.
    const double s = sign < 0 ? -1.0 : 1.0;
    glm::dmat4 turn(1.0);
    if (axis == 2)
      turn = glm::mat4_cast(glm::angleAxis(glm::radians(-90.0 * s), glm::dvec3(1, 0, 0)));
    else if (axis == 0)
      turn = glm::mat4_cast(glm::angleAxis(glm::radians(90.0 * s), glm::dvec3(0, 0, 1)));
    else
      turn = glm::mat4_cast(glm::angleAxis(glm::radians(180.0), glm::dvec3(1, 0, 0)));
    // Above the root, which may itself be animated.
    GraphNode top;
    top.name = "up";
    top.parent_from_node = turn;
    for (GraphNode& node : graph_.nodes) node.parent = node.parent ? *node.parent + 1 : 0;
    graph_.nodes.insert(graph_.nodes.begin(), std::move(top));
  }

  void add_warnings() {
    if (points_and_lines_ > 0)
      warnings_.emplace_back(std::to_string(points_and_lines_) + " points and lines were left out.");
    if (has_transparency_) warnings_.emplace_back("Materials with alpha (masked or blended) are drawn opaque.");
    if (has_skins_) warnings_.emplace_back("Skinned meshes are drawn in the pose that they were modelled in.");
    if (has_more_animations_) warnings_.emplace_back("Only the first animation of each node is played.");
  }

  const aiScene& source_;
  std::vector<std::string>& warnings_;
  SceneGraph graph_;
  std::map<std::string, uint32_t> node_by_name_;
  size_t points_and_lines_ = 0;
  bool has_transparency_ = false, has_skins_ = false, has_more_animations_ = false;
};

}  // namespace

SceneGraph read_with_assimp(const std::string& path, const Progress& progress, std::vector<std::string>& warnings) {
  Assimp::Importer importer;
  std::exception_ptr cancelled;
  importer.SetProgressHandler(std::make_unique<ProgressBridge>(progress, cancelled).release());  // the importer owns it
  // Only positions matter here; without the rest, vertices along texture seams join again.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_COLORS | aiComponent_TEXCOORDS |
                                                          aiComponent_TEXTURES);
  const aiScene* source =
      importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (cancelled) std::rethrow_exception(cancelled);
  if (!source || !source->mRootNode)
    throw InputError(path, "is not a scene that can be read", "give a glTF, GLB or another file that assimp reads");
  return Converter(*source, warnings).convert(is_z_up_format(path));
}

}  // namespace shadewright
