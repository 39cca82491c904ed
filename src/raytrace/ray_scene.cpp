#include "raytrace/ray_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
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
RtcPtr<RTCBuffer> copy_triangles(RTCDevice device, const Mesh& mesh) {
  if (mesh.triangles.empty()) return nullptr;
  RtcPtr<RTCBuffer> buffer(rtcNewBuffer(device, mesh.triangles.size() * sizeof(glm::uvec3)));
  check(device, "copying triangles");
  std::ranges::copy(mesh.triangles, static_cast<glm::uvec3*>(rtcGetBufferData(buffer.get())));
  return buffer;
}

// Embree finds the distance to a triangle in float, with an error of some 2^-24 of the triangle's extent: at a large
// triangle far more than the distance between a shadow ray's origin and the surface it starts from. So where Embree
// sees a hit, this asks in double whether the triangle's plane lies ahead of the origin, and takes the hit back if not.
void reject_planes_behind(const RTCFilterFunctionNArguments* arguments) {
  const auto& geometry = *static_cast<const RayTriangles*>(arguments->geometryUserPtr);
  RTCRayN* const ray = arguments->ray;
  const unsigned lanes = arguments->N;
  for (unsigned i = 0; i < lanes; ++i) {
    if (arguments->valid[i] == 0) continue;
    const glm::dvec3 origin(RTCRayN_org_x(ray, lanes, i), RTCRayN_org_y(ray, lanes, i), RTCRayN_org_z(ray, lanes, i));
    const glm::dvec3 direction(RTCRayN_dir_x(ray, lanes, i), RTCRayN_dir_y(ray, lanes, i),
                               RTCRayN_dir_z(ray, lanes, i));
    const std::array<glm::vec3, 3> corners = geometry.corners(RTCHitN_primID(arguments->hit, lanes, i));
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
    if (glm::dot(a - origin, normal) * glm::dot(direction, normal) <= 0) arguments->valid[i] = 0;
  }
}

// An Embree geometry of the mesh's `triangles` with its positions taken through `convert`. `view` is set to its buffers
// and must outlive it, in place.
template <typename Convert>
RtcPtr<RTCGeometry> new_geometry(RTCDevice device, const Mesh& mesh, RTCBuffer triangles, Convert convert,
                                 RayTriangles& view) {
  RtcPtr<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles, 0, sizeof(glm::uvec3),
                       mesh.triangles.size());
  auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  check(device, "copying positions");
  std::ranges::transform(mesh.positions, positions, convert);
  view = {positions, static_cast<const glm::uvec3*>(rtcGetBufferData(triangles))};
  rtcSetGeometryUserData(geometry.get(), &view);
  rtcSetGeometryOccludedFilterFunction(geometry.get(), reject_planes_behind);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

}  // namespace

RayScene::RayScene(const Scene& scene, double time, size_t flatten_limit)
    : device_(rtcNewDevice(nullptr)), instanced_(triangle_count(scene) > flatten_limit) {
  if (!device_) throw FailureError("ray tracer", "Embree does not start on this machine");
  scene_ = new_scene(device_.get());
  for (size_t i = 0; i < scene.instances.size(); ++i)
    placed_.push_back(
        {instanced_ ? scene.instances[i].mesh : i, glm::mat4(transform_at(scene, scene.instances[i], time))});
  if (instanced_)
    add_instanced(scene);
  else
    add_flattened(scene);
  rtcCommitScene(scene_.get());
  check(device_.get(), "building the scene's hierarchy");
}

void RayScene::update(const Scene& scene, double time) {
  if (scene.instances.size() != placed_.size()) throw std::logic_error("not the scene that RayScene was made of");
  bool any_moved = false;
  for (size_t i = 0; i < placed_.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.motion) continue;
    const glm::mat4 world_from_mesh(transform_at(scene, instance, time));
    if (world_from_mesh == placed_[i].world_from_mesh) continue;
    placed_[i].world_from_mesh = world_from_mesh;
    RTCGeometry geometry = rtcGetGeometry(scene_.get(), static_cast<unsigned>(i));
    if (geometry == nullptr) continue;  // a mesh without triangles
    any_moved = true;
    if (instanced_) {
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &world_from_mesh[0][0]);
    } else {
      auto* positions = static_cast<glm::vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
      std::ranges::transform(scene.meshes[instance.mesh].positions, positions,
                             [&](const glm::vec3& p) { return to_world(world_from_mesh, p); });
      rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    }
    rtcCommitGeometry(geometry);
  }
  if (!any_moved) return;
  // Flattened, this builds the hierarchy anew over all triangles. A dynamic scene, whose moved bodies are refitted,
  // took as long to update (street, characters: 44 to 58 ms of processor time either way) and its rays up to a seventh
  // longer.
  rtcCommitScene(scene_.get());
  check(device_.get(), "building the scene's hierarchy");
}

void RayScene::add_flattened(const Scene& scene) {
  std::vector<RtcPtr<RTCBuffer>> triangles;
  for (const Mesh& mesh : scene.meshes) triangles.push_back(copy_triangles(device_.get(), mesh));
  geometries_.resize(scene.instances.size());
  tbb::parallel_for(size_t{0}, scene.instances.size(), [&](size_t i) {
    const uint32_t mesh = scene.instances[i].mesh;
    if (!triangles[mesh]) return;
    const auto convert = [&](const glm::vec3& p) { return to_world(placed_[i].world_from_mesh, p); };
    const auto geometry =
        new_geometry(device_.get(), scene.meshes[mesh], triangles[mesh].get(), convert, geometries_[i]);
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i));
  });
}

void RayScene::add_instanced(const Scene& scene) {
  std::vector<RtcPtr<RTCScene>> hierarchies(scene.meshes.size());
  geometries_.resize(scene.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const auto triangles = copy_triangles(device_.get(), scene.meshes[i]);
    if (!triangles) continue;
    const auto geometry =
        new_geometry(device_.get(), scene.meshes[i], triangles.get(), std::identity(), geometries_[i]);
    hierarchies[i] = new_scene(device_.get());
    rtcAttachGeometryByID(hierarchies[i].get(), geometry.get(), 0);
    rtcCommitScene(hierarchies[i].get());
    check(device_.get(), "building a mesh's hierarchy");
  }
  for (size_t i = 0; i < placed_.size(); ++i) {
    const Placed& placed = placed_[i];
    if (!hierarchies[placed.geometry]) continue;
    const RtcPtr<RTCGeometry> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check(device_.get(), "placing an instance");
    rtcSetGeometryInstancedScene(geometry.get(), hierarchies[placed.geometry].get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &placed.world_from_mesh[0][0]);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(i));
  }
}

}  // namespace shadewright
