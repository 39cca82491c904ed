#include "shadewright/render/scene_gpu.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <stdexcept>

#include "render/closed_bodies.h"
#include "render/octahedral.h"
#include "render/shared.h"
#include "render/triangle_folds.h"

namespace shadewright::render {

namespace {

// Large clusters: each is a draw, and a draw has a price of its own; limits of meshoptimizer 0.18.
constexpr size_t max_cluster_vertices = 255, max_cluster_triangles = 512;

struct MeshClusters {
  std::vector<glm::uvec3> triangles;  ///< in cluster order
  std::vector<glm::uvec3> across;     ///< see MeshTopology, of those
  std::vector<uint32_t> first;        ///< first triangle of each cluster
  uint32_t closed = 0;                ///< how many of the clusters, from the first on, bound closed bodies
};

/// Appends clusters of some of the mesh's triangles.
void append_clusters(MeshClusters& result, const Mesh& mesh, std::span<const glm::uvec3> triangles) {
  if (triangles.empty()) return;
  if (triangles.size() <= max_cluster_triangles) {
    result.first.push_back(static_cast<uint32_t>(result.triangles.size()));
    result.triangles.insert(result.triangles.end(), triangles.begin(), triangles.end());
    return;
  }
  const size_t index_count = 3 * triangles.size();
  const auto* indices = reinterpret_cast<const uint32_t*>(triangles.data());
  const size_t bound = meshopt_buildMeshletsBound(index_count, max_cluster_vertices, max_cluster_triangles);
  std::vector<meshopt_Meshlet> meshlets(bound);
  std::vector<uint32_t> vertices(bound * max_cluster_vertices);
  std::vector<unsigned char> corners(bound * max_cluster_triangles * 3);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), corners.data(), indices, index_count,
                                        &mesh.positions.front().x, mesh.positions.size(), sizeof(glm::vec3),
                                        max_cluster_vertices, max_cluster_triangles, 0.0f));
  for (const meshopt_Meshlet& meshlet : meshlets) {
    result.first.push_back(static_cast<uint32_t>(result.triangles.size()));
    for (uint32_t t = 0; t < meshlet.triangle_count; ++t) {
      const auto corner = [&](uint32_t k) {
        return vertices[meshlet.vertex_offset + corners[meshlet.triangle_offset + 3 * t + k]];
      };
      result.triangles.emplace_back(corner(0), corner(1), corner(2));
    }
  }
}

/// `topology.across` for `triangles`, which are the mesh's in another order, their corners too.
std::vector<glm::uvec3> across_in_order(const Mesh& mesh, const MeshTopology& topology,
                                        std::span<const glm::uvec3> triangles) {
  // Edges by the corner they leave from.
  struct Edge {
    uint32_t to, across;
  };
  std::vector<uint32_t> starts(mesh.positions.size() + 1, 0);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int e = 0; e < 3; ++e) ++starts[triangle[e] + 1];
  std::inclusive_scan(starts.begin(), starts.end(), starts.begin());
  std::vector<uint32_t> ends(starts.begin(), starts.end() - 1);
  std::vector<Edge> edges(starts.back());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int e = 0; e < 3; ++e)
      edges[ends[mesh.triangles[t][e]]++] = {mesh.triangles[t][(e + 1) % 3], topology.across[t][e]};
  std::vector<glm::uvec3> result(triangles.size(), glm::uvec3(no_vertex));
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int e = 0; e < 3; ++e) {
      const uint32_t from = triangles[t][e], to = triangles[t][(e + 1) % 3];
      for (uint32_t i = starts[from]; i < starts[from + 1]; ++i)
        if (edges[i].to == to) result[t][e] = edges[i].across;
    }
  return result;
}

MeshClusters make_clusters(const Mesh& mesh) {
  const MeshTopology topology = mesh_topology(mesh);
  std::vector<glm::uvec3> parts[2];
  for (size_t t = 0; t < mesh.triangles.size(); ++t) parts[topology.closed[t] ? 0 : 1].push_back(mesh.triangles[t]);
  MeshClusters result;
  result.triangles.reserve(mesh.triangles.size());
  append_clusters(result, mesh, parts[0]);
  result.closed = static_cast<uint32_t>(result.first.size());
  append_clusters(result, mesh, parts[1]);
  result.across = across_in_order(mesh, topology, result.triangles);
  return result;
}

shared::InstanceData instance_data(const Instance& instance, const glm::dmat4& world_from_mesh) {
  const InstanceFilter kind = instance.motion ? InstanceFilter::moving : InstanceFilter::unmoving;
  return {glm::mat4x3(glm::mat4(world_from_mesh)), glm::packUnorm4x8(glm::vec4(instance.albedo, 1.0f)),
          static_cast<uint32_t>(kind)};
}

uint32_t packed_normal(const Mesh& mesh, const glm::uvec3& triangle) {
  const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]), c(mesh.positions[triangle.z]);
  return octahedral_packed(glm::cross(b - a, c - a));
}

uint64_t next_generation() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

}  // namespace

SceneGpu::SceneGpu(const gpu::Device& device, const Scene& scene, double time, uint32_t frames_in_flight)
    : device_(device), generation_(next_generation()) {
  // Instances of one mesh side by side, in the scene's order.
  std::vector<uint32_t> instance_order(scene.instances.size());
  std::iota(instance_order.begin(), instance_order.end(), 0u);
  std::stable_sort(instance_order.begin(), instance_order.end(),
                   [&](uint32_t a, uint32_t b) { return scene.instances[a].mesh < scene.instances[b].mesh; });
  for (const Mesh& mesh : scene.meshes) mesh_bounds_.push_back(shadewright::bounds(mesh));

  std::vector<shared::InstanceData> instances;
  std::vector<glm::uvec2> mesh_instances(scene.meshes.size(), glm::uvec2(0));
  instance_bounds_.resize(scene.instances.size());
  std::vector<uint32_t> device_order(scene.instances.size());
  for (const uint32_t index : instance_order) {
    const Instance& instance = scene.instances[index];
    const glm::dmat4 world_from_mesh = transform_at(scene, instance, time);
    if (mesh_instances[instance.mesh].y++ == 0)
      mesh_instances[instance.mesh].x = static_cast<uint32_t>(instances.size());
    device_order[index] = static_cast<uint32_t>(instances.size());
    instances.push_back(instance_data(instance, world_from_mesh));
    instance_bounds_[index] = transform(world_from_mesh, mesh_bounds_[instance.mesh]);
    instance_centers_.emplace_back(instance_bounds_[index].center());
    bounds_.extend(instance_bounds_[index]);
    if (!instance.motion) unmoving_bounds_.extend(instance_bounds_[index]);
  }

  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  TriangleFolds folds;
  std::vector<uint32_t> normals;
  std::vector<shared::ClusterData> clusters;
  std::vector<uint32_t> listed_clusters;
  std::vector<uint32_t> mesh_first_cluster(scene.meshes.size() + 1, 0);
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const glm::uvec2 shown = mesh_instances[m];
    mesh_first_cluster[m] = static_cast<uint32_t>(clusters.size());
    if (shown.y == 0 || mesh.triangles.empty()) continue;
    const auto base = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    const MeshClusters parts = make_clusters(mesh);
    append_folds(folds, mesh.positions, parts.triangles, parts.across);
    triangle_count_ += mesh.triangles.size() * shown.y;
    for (size_t c = 0; c < parts.first.size(); ++c) {
      const uint32_t begin = parts.first[c];
      const auto end = c + 1 < parts.first.size() ? parts.first[c + 1] : static_cast<uint32_t>(parts.triangles.size());
      Box box;
      float longest_edge = 0;
      const auto first_index = static_cast<uint32_t>(3 * triangles.size());
      for (uint32_t t = begin; t < end; ++t) {
        const glm::uvec3 triangle = parts.triangles[t];
        for (int k = 0; k < 3; ++k) box.extend(glm::dvec3(mesh.positions[triangle[k]]));
        for (int k = 0; k < 3; ++k)
          longest_edge =
              std::max(longest_edge, glm::distance(mesh.positions[triangle[k]], mesh.positions[triangle[(k + 1) % 3]]));
        triangles.push_back(triangle + base);
        normals.push_back(packed_normal(mesh, triangle));
      }
      clusters.push_back({glm::vec3(box.center()), glm::vec3(0.5 * box.size()), first_index, 3 * (end - begin), shown.x,
                          shown.y, list_capacity_, c < parts.closed ? shared::body_closed : 0, longest_edge,
                          listed_triangles_});
      list_capacity_ += shown.y;
      listed_clusters.resize(list_capacity_, static_cast<uint32_t>(clusters.size() - 1));
      constexpr uint32_t alignment = shared::listed_alignment;
      listed_triangles_ += shown.y * ((end - begin + alignment - 1) / alignment * alignment);
      cluster_mesh_centers_.emplace_back(box.center());
      cluster_centers_.push_back(instances[shown.x].world_from_mesh * glm::vec4(cluster_mesh_centers_.back(), 1.0f));
      cluster_instances_.push_back(shown);
    }
  }
  cluster_count_ = static_cast<uint32_t>(clusters.size());
  mesh_first_cluster.back() = cluster_count_;

  positions_ = gpu::make_buffer<glm::vec3>(device, "scene positions", positions);
  indices_ = gpu::make_buffer<glm::uvec3>(device, "scene indices", triangles);
  fold_normals_ = gpu::make_buffer<glm::uvec4>(device, "scene fold normals", folds.normals);
  fold_offsets_ = gpu::make_buffer<glm::vec4>(device, "scene fold offsets", folds.offsets);
  normals_ = gpu::make_buffer<uint32_t>(device, "scene triangle normals", normals);
  instances_ = gpu::make_buffer<shared::InstanceData>(device, "scene instances", instances);
  clusters_ = gpu::make_buffer<shared::ClusterData>(device, "scene clusters", clusters);
  listed_clusters_ = gpu::make_buffer<uint32_t>(device, "scene listed clusters", listed_clusters);

  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.motion) continue;
    const uint32_t first = mesh_first_cluster[instance.mesh];
    const uint32_t at = device_order[i];
    constexpr vk::DeviceSize bytes = sizeof(shared::InstanceData);
    const vk::DeviceSize from = movers_.size() * bytes, to = at * bytes;
    if (!moving_runs_.empty() && moving_runs_.back().dstOffset + moving_runs_.back().size == to)
      moving_runs_.back().size += bytes;
    else
      moving_runs_.push_back({from, to, bytes});
    moving_instances_.push_back(i);
    movers_.push_back(
        {at, instance.mesh, first, mesh_first_cluster[instance.mesh + 1] - first, instances[at].world_from_mesh});
  }
  moved_.reserve(movers_.size());
  if (movers_.empty()) return;
  for (uint32_t slot = 0; slot < frames_in_flight; ++slot)
    staging_.emplace_back(device, "scene moving instances", movers_.size() * sizeof(shared::InstanceData),
                          gpu::HostAccess::write);
}

void SceneGpu::place_clusters(const Mover& mover) {
  for (uint32_t c = mover.first_cluster; c < mover.first_cluster + mover.cluster_count; ++c)
    if (cluster_instances_[c].x == mover.device_index)
      cluster_centers_[c] = mover.world_from_mesh * glm::vec4(cluster_mesh_centers_[c], 1.0f);
}

void SceneGpu::update(const Scene& scene, double time, uint32_t slot, gpu::Recorder& recorder) {
  if (scene.instances.size() != instance_bounds_.size())
    throw std::logic_error("not the scene that SceneGpu was made of");
  ++update_count_;
  moved_.clear();
  if (movers_.empty()) return;
  if (slot >= staging_.size()) throw std::logic_error("not a frame in flight that SceneGpu was made for");
  const auto staging = staging_[slot].mapped<shared::InstanceData>();
  bounds_ = unmoving_bounds_;
  for (size_t m = 0; m < movers_.size(); ++m) {
    Mover& mover = movers_[m];
    const uint32_t index = moving_instances_[m];
    const glm::dmat4 world_from_mesh = transform_at(scene, scene.instances[index], time);
    staging[m] = instance_data(scene.instances[index], world_from_mesh);
    Box& box = instance_bounds_[index];
    if (staging[m].world_from_mesh != mover.world_from_mesh) {
      mover.world_from_mesh = staging[m].world_from_mesh;
      const Box now = transform(world_from_mesh, mesh_bounds_[mover.mesh]);
      moved_.push_back({index, box, now});
      box = now;
      instance_centers_[mover.device_index] = glm::vec3(box.center());
      place_clusters(mover);
    }
    bounds_.extend(box);
  }
  recorder.stage("scene", [&](const vk::raii::CommandBuffer& commands) {
    gpu::memory_barrier(commands);  // frames before this one have read their instances
    commands.copyBuffer(staging_[slot].handle(), instances_.handle(), moving_runs_);
  });
}

std::vector<uint32_t> SceneGpu::front_to_back(const glm::dvec3& eye) const {
  const glm::vec3 from(eye);
  const auto squared = [&](const glm::vec3& p) { return glm::dot(p - from, p - from); };
  // A mesh shown many times is drawn by one command: its nearest instance speaks for it, found once a mesh.
  std::vector<std::pair<float, uint32_t>> keys(cluster_count_);
  glm::uvec2 last(~0u);
  float nearest = 0;
  for (uint32_t c = 0; c < cluster_count_; ++c) {
    const glm::uvec2 shown = cluster_instances_[c];
    if (shown.y == 1) {
      keys[c] = {squared(cluster_centers_[c]), c};
      continue;
    }
    if (shown != last) {
      nearest = std::numeric_limits<float>::infinity();
      for (uint32_t i = 0; i < shown.y; ++i) nearest = std::min(nearest, squared(instance_centers_[shown.x + i]));
      last = shown;
    }
    keys[c] = {nearest, c};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> order(cluster_count_);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

std::vector<Allocation> SceneGpu::allocations() const {
  std::vector<Allocation> result{positions_.allocation(),    indices_.allocation(),        fold_normals_.allocation(),
                                 fold_offsets_.allocation(), normals_.allocation(),        instances_.allocation(),
                                 clusters_.allocation(),     listed_clusters_.allocation()};
  for (const gpu::Buffer& staging : staging_) result.push_back(staging.allocation());
  return result;
}

}  // namespace shadewright::render
