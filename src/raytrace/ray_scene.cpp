#include "raytrace/ray_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "shadewright/error.h"

namespace shadewright {
namespace {

// Embree keeps one error a thread; it is asked for where a call may run out of memory.
void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw FailureError("ray tracer", std::string("out of memory while ") + doing, "give it a smaller scene");
  throw FailureError("ray tracer",
                     std::string("Embree error ") + std::to_string(static_cast<int>(error)) + " while " + doing);
}

RtcPtr<RTCScene> new_scene(RTCDevice device) {
  RtcPtr<RTCScene> scene(rtcNewScene(device));
  check(device, "making a scene");
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

// A mesh's triangles, copied once and shared by the geometries made of it; null for a mesh without any.
RtcPtr<RTCBuffer> new_triangles(RTCDevice device, const Mesh& mesh) {
  if (mesh.triangles.empty()) return nullptr;
  RtcPtr<RTCBuffer> buffer(rtcNewBuffer(device, mesh.triangles.size() * sizeof(glm::uvec3)));
  check(device, "copying triangles");
  std::ranges::copy(mesh.triangles, static_cast<glm::uvec3*>(rtcGetBufferData(buffer.get())));
  return buffer;
}

// A geometry with room for the mesh's positions, returned in `positions`: to be filled, then committed.
RtcPtr<RTCGeometry> new_geometry(RTCDevice device, const Mesh& mesh, RTCBuffer triangles, glm::vec3*& positions) {
  RtcPtr<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles, 0, sizeof(glm::uvec3),
                       mesh.triangles.size());
  positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  check(device, "copying positions");
  return geometry;
}

}  // namespace

RayScene::RayScene(const Scene& scene, double time, size_t flatten_limit)
    : device_(rtcNewDevice(nullptr)), instanced_(triangle_count(scene) > flatten_limit) {
  if (!device_) throw FailureError("ray tracer", "Embree does not start on this machine");
  scene_ = new_scene(device_.get());
  placed_.resize(scene.instances.size());
  std::vector<RtcPtr<RTCBuffer>> triangles(scene.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) triangles[i] = new_triangles(device_.get(), scene.meshes[i]);
  for (size_t i = 0; i < placed_.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const RTCBuffer buffer = triangles[instance.mesh].get();
    placed_[i].triangles = buffer ? static_cast<const glm::uvec3*>(rtcGetBufferData(buffer)) : nullptr;
    placed_[i].world_from_mesh = glm::mat4(transform_at(scene, instance, time));
  }
  if (instanced_)
    add_instanced(scene, triangles);
  else
    add_flattened(scene, triangles);
  rtcCommitScene(scene_.get());
  check(device_.get(), "building the scene's hierarchy");
}

void RayScene::add_flattened(const Scene& scene, std::span<const RtcPtr<RTCBuffer>> triangles) {
  tbb::parallel_for(size_t{0}, placed_.size(), [&](size_t i) {
    if (!placed_[i].triangles) return;
    const uint32_t mesh = scene.instances[i].mesh;
    glm::vec3* positions = nullptr;
    const auto geometry = new_geometry(device_.get(), scene.meshes[mesh], triangles[mesh].get(), positions);
    std::ranges::transform(scene.meshes[mesh].positions, positions,
                           [&](const glm::vec3& p) { return to_world(placed_[i].world_from_mesh, p); });
    placed_[i].positions = positions;
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i));
  });
}

void RayScene::add_instanced(const Scene& scene, std::span<const RtcPtr<RTCBuffer>> triangles) {
  std::vector<RtcPtr<RTCScene>> hierarchies(scene.meshes.size());
  std::vector<const glm::vec3*> mesh_positions(scene.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!triangles[i]) continue;
    glm::vec3* positions = nullptr;
    const auto geometry = new_geometry(device_.get(), scene.meshes[i], triangles[i].get(), positions);
    std::ranges::copy(scene.meshes[i].positions, positions);
    mesh_positions[i] = positions;
    rtcCommitGeometry(geometry.get());
    hierarchies[i] = new_scene(device_.get());
    rtcAttachGeometryByID(hierarchies[i].get(), geometry.get(), 0);
    rtcCommitScene(hierarchies[i].get());
    check(device_.get(), "building a mesh's hierarchy");
  }
  for (size_t i = 0; i < placed_.size(); ++i) {
    if (!placed_[i].triangles) continue;
    const uint32_t mesh = scene.instances[i].mesh;
    placed_[i].positions = mesh_positions[mesh];
    const RtcPtr<RTCGeometry> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check(device_.get(), "placing an instance");
    rtcSetGeometryInstancedScene(geometry.get(), hierarchies[mesh].get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &placed_[i].world_from_mesh[0][0]);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i));
  }
}

}  // namespace shadewright
