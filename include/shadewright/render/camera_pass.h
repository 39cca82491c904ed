// What the camera sees: depth and geometric normals, the input of every shadow technique and of the reference.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "shadewright/gpu/recorder.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/render/scene_gpu.h"
#include "shadewright/scene/scene.h"

namespace shadewright::shared {
struct CameraData;
}

namespace shadewright::render {

/// A perspective camera as a matrix: any depth convention (standard or reversed, finite or infinite far) and any
/// jitter, since both are read off the matrix.
struct CameraView {
  glm::dmat4 clip_from_world{1.0};  ///< Vulkan clip space
  uint32_t width = 0, height = 0;   ///< pixels
  float background_depth = 0;       ///< what the depth buffer holds where nothing was drawn (0 reversed, 1 standard)

  /// World position of the centre of projection.
  glm::dvec3 eye() const;
  /// The half-spaces of what it sees, world space.
  std::vector<Plane> planes() const { return frustum_planes(clip_from_world); }
  /// World direction through image position `pixel` (pixels, y down), scaled so that its view depth is 1.
  glm::dvec3 ray(const glm::dvec2& pixel) const;
};

/// Our own camera: reversed depth, infinite far plane.
CameraView make_view(const Camera& camera, double near, uint32_t width, uint32_t height);

/// The shaders' form of `view`. InputError for an orthographic camera (its depth tells no distance along a ray from the
/// eye).
shared::CameraData camera_data(const CameraView& view);

/// Draws depth (D32, reversed) and octahedral geometric normals (RG16 snorm), and the albedo if wanted (RGBA8).
class CameraPass {
 public:
  CameraPass(const SceneGpu& scene, uint32_t width, uint32_t height, bool with_albedo);

  /// Records the stage "camera". Both images are left readable by shaders.
  void record(gpu::Recorder& recorder, const CameraView& view);

  gpu::Image& depth() { return depth_; }
  gpu::Image& normal() { return normal_; }
  gpu::Image& albedo() { return albedo_; }
  std::vector<Allocation> allocations() const;

  /// Reads depth and normals back as surface points, row by row; pixels without geometry have a zero normal.
  std::vector<SurfacePoint> surface_points(const CameraView& view);

 private:
  const SceneGpu& scene_;
  gpu::Image depth_, normal_, albedo_;
  gpu::Buffer camera_;
  CulledDraws draws_;
  gpu::GraphicsPass pass_;
};

}  // namespace shadewright::render
