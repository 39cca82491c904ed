// A scene on the device: vertices, indices, instances and clusters, and the culled draws of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadewright/geometry/polytope.h"
#include "shadewright/gpu/pass.h"
#include "shadewright/gpu/recorder.h"
#include "shadewright/gpu/resources.h"
#include "shadewright/scene/scene.h"

namespace shadewright::render {

/// An instance that an update moved, for whoever keeps something from one frame to the next: what its shadow covered
/// before and covers now must be drawn anew.
struct MovedInstance {
  uint32_t instance = 0;  ///< index into Scene::instances
  Box before, now;        ///< world bounds
};

/// Which instances a view draws: those without a motion, those with one (whether it moves them now or not), or both.
/// The values are the bits that cull.comp tests.
enum class InstanceFilter : uint32_t { unmoving = 1, moving = 2, all = 3 };

/// Device copy of a scene's geometry. Triangles are grouped into clusters of neighbours (meshoptimizer), so that a view
/// draws only what it may see. Instances of one mesh share its vertices.
class SceneGpu {
 public:
  /// Uploads `scene` as it stands at `time` seconds, and waits. `frames_in_flight` is how many updates may be under way
  /// on the device at once.
  SceneGpu(const gpu::Device& device, const Scene& scene, double time = 0, uint32_t frames_in_flight = 2);

  /// Moves the instances that have a motion to where they are at `time`. `scene` is the one this was made of. What the
  /// host asks for (bounds, moved instances, front to back) changes now; the device's copy changes by commands recorded
  /// as the stage "scene", in the order of the queue, so that frames in flight still draw what they were recorded for.
  /// Neither allocates nor waits. The frame that used `slot` < frames_in_flight before must have finished on the
  /// device.
  void update(const Scene& scene, double time, uint32_t slot, gpu::Recorder& recorder);

  /// Indices into Scene::instances of those that have a motion, ascending: all that can ever move.
  std::span<const uint32_t> moving_instances() const { return moving_instances_; }
  /// Those that the last update moved, by ascending instance; empty before the first one.
  std::span<const MovedInstance> moved() const { return moved_; }
  /// How many updates there were. Who last looked more than one update ago can't go by `moved` alone.
  uint64_t update_count() const { return update_count_; }

  const gpu::Device& device() const { return device_; }
  /// Another number for each scene that is made in this process: a new one may stand at an old one's address.
  uint64_t generation() const { return generation_; }
  /// World bounds of all instances.
  const Box& bounds() const { return bounds_; }
  /// World bounds of each instance, by its index in Scene::instances.
  std::span<const Box> instance_bounds() const { return instance_bounds_; }
  uint64_t triangle_count() const { return triangle_count_; }

  const gpu::Buffer& positions() const { return positions_; }  ///< float3 a vertex, mesh space
  const gpu::Buffer& indices() const { return indices_; }      ///< uint32, cluster after cluster
  /// What tells silhouettes, mesh space: of each triangle and those beyond its edges uint32 x 4 normals, and float4
  /// offsets (render/triangle_folds.h).
  const gpu::Buffer& fold_normals() const { return fold_normals_; }
  const gpu::Buffer& fold_offsets() const { return fold_offsets_; }
  const gpu::Buffer& triangle_normals() const { return normals_; }  ///< octahedral 2 x snorm16 a triangle, mesh space
  const gpu::Buffer& instances() const { return instances_; }       ///< shared::InstanceData
  const gpu::Buffer& clusters() const { return clusters_; }         ///< shared::ClusterData
  uint32_t cluster_count() const { return cluster_count_; }
  /// Sum over clusters of how many instances show them: the longest list of visible instances.
  uint32_t list_capacity() const { return list_capacity_; }
  /// The cluster whose instances are listed at each of these places.
  const gpu::Buffer& listed_clusters() const { return listed_clusters_; }
  /// Places for every triangle of every instance (VisibleInstance::first_listed).
  uint32_t listed_triangles() const { return listed_triangles_; }
  /// A world-space point of each cluster's nearest instance is found from these: centres of clusters shown once, else
  /// the mesh's instances' centres. Used to draw front to back.
  std::vector<uint32_t> front_to_back(const glm::dvec3& eye) const;

  std::vector<Allocation> allocations() const;

 private:
  /// Where an instance that has a motion stands in the device's order, and the clusters of its mesh.
  struct Mover {
    uint32_t device_index = 0, mesh = 0, first_cluster = 0, cluster_count = 0;
    glm::mat4x3 world_from_mesh{1.0f};
  };

  /// World centres of the clusters whose first instance is `mover`.
  void place_clusters(const Mover& mover);

  const gpu::Device& device_;
  uint64_t generation_;
  Box bounds_, unmoving_bounds_;
  std::vector<Box> instance_bounds_, mesh_bounds_;
  std::vector<uint32_t> moving_instances_;
  std::vector<Mover> movers_;  ///< by moving instance
  std::vector<MovedInstance> moved_;
  uint64_t update_count_ = 0;
  uint64_t triangle_count_ = 0;
  uint32_t cluster_count_ = 0, list_capacity_ = 0, listed_triangles_ = 0;
  std::vector<glm::vec3> cluster_mesh_centers_;  ///< mesh space
  std::vector<glm::vec3> cluster_centers_;       ///< world, of the cluster's first instance
  std::vector<glm::uvec2> cluster_instances_;    ///< first, count
  std::vector<glm::vec3> instance_centers_;      ///< in device order
  gpu::Buffer positions_, indices_, fold_normals_, fold_offsets_, normals_, instances_, clusters_, listed_clusters_;
  std::vector<gpu::Buffer> staging_;         ///< by slot, host-written: shared::InstanceData of each moving instance
  std::vector<vk::BufferCopy> moving_runs_;  ///< from the staging to the instances: neighbours in one copy
};

/// How much of render/scene_vertex.glsl a vertex shader reads: the number of its locations.
enum class SceneInputs : uint32_t { position = 4, surface = 5, colored_surface = 6 };

/// The draws of one consumer (a camera, a light's views): culled on the device into indirect commands.
class CulledDraws {
 public:
  /// Room for `max_views` views of `scene`, for each of `frames_in_flight` frames. `name` prefixes the allocations'
  /// names.
  CulledDraws(const SceneGpu& scene, uint32_t max_views, uint32_t frames_in_flight, const std::string& name);

  /// What each view must contain: at most 12 half-spaces a view, world space. `order` lists the clusters in drawing
  /// order (empty = as stored). Only instances that `filter` lets through are drawn. Written for the frame `slot` <
  /// frames_in_flight; host writes only.
  void set_views(uint32_t slot, std::span<const std::vector<Plane>> views, std::span<const uint32_t> order = {},
                 InstanceFilter filter = InstanceFilter::all);

  /// Culls all views of `slot`. A barrier must follow before `draw`.
  void cull(const vk::raii::CommandBuffer& commands, uint32_t slot) const;
  /// Draws what survived in `view`; the graphics pass with its bindings is bound by the caller.
  void draw(const vk::raii::CommandBuffer& commands, uint32_t view) const;

  /// What culling leaves, for passes that work on it: shared::DrawCommand by cluster in drawing order, view after view,
  /// the shared::VisibleInstance that they show, and the cluster of each draw.
  const gpu::Buffer& commands() const { return draws_; }
  const gpu::Buffer& visible() const { return visible_; }
  const gpu::Buffer& order(uint32_t slot) const { return order_[slot]; }

  /// Gives a graphics pass that draws these the vertex inputs of render/scene_vertex.glsl, as many as its shader reads.
  static void set_vertex_input(gpu::GraphicsDesc& desc, SceneInputs inputs);
  std::vector<Allocation> allocations() const;

 private:
  const SceneGpu& scene_;
  uint32_t max_views_;
  std::vector<uint32_t> view_counts_;  ///< by slot
  gpu::ComputePass pass_;
  std::vector<gpu::Buffer> views_, order_;  ///< by slot, host-written
  gpu::Buffer draws_, visible_;
};

}  // namespace shadewright::render
