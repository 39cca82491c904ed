// The one interface of all techniques: a frame goes in, a visibility image comes out (architecture, section 3).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shadewright/gpu/recorder.h"
#include "shadewright/gpu/resources.h"
#include "shadewright/progress.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/render/image.h"
#include "shadewright/render/scene_gpu.h"
#include "shadewright/scene/scene.h"
#include "shadewright/shadow/spec.h"

namespace shadewright::voxel {
struct BakeOptions;
class VoxelShadow;
}  // namespace shadewright::voxel

namespace shadewright::shadow {

/// One thing to draw casters into: a layer of the shadow map through one matrix.
struct MapView {
  glm::dmat4 light_from_world{1.0};  ///< light clip space; depth grows away from the light
  std::vector<Plane> casters;        ///< half-spaces that hold every caster that can matter in this view, world space
  uint32_t layer = 0;
  vk::Rect2D viewport;
  bool drawn = true;  ///< false: nothing receives here, and the layer holds nothing
};

/// What a caller's own casters are drawn with. The rendering has begun, viewport and scissor are set. The caller's
/// pipeline has a D32 depth attachment and no color, writes depth with compare "less", and clamps it (casters before
/// the map's nearest depth count); for storage "moments" also an RG32F color, see caster_moments.glsl. Its vertex
/// shader includes the first of Technique::lookup_includes(), which declares the resources of one descriptor set
/// (number SHADEWRIGHT_LOOKUP_SET, 1 unless defined before), and ends with gl_Position = map_caster(world, view). Its
/// layout has Technique::lookup_layout() at that number, where the callback binds `set`.
struct CasterDraw {
  const vk::raii::CommandBuffer& commands;
  uint32_t view = 0;  ///< index for map_caster
  const MapView& map_view;
  vk::DescriptorSet set;
};
using CasterCallback = std::function<void(const CasterDraw&)>;

/// What a technique works on. Everything referred to stays alive until the recorded commands have run.
struct Frame {
  const render::SceneGpu* scene = nullptr;  ///< casters and bounds; may be null when `draw_casters` draws them all
  CasterCallback draw_casters;              ///< casters of the caller's own, in addition
  Box draw_bounds;                          ///< world bounds of those
  render::InstanceFilter casters = render::InstanceFilter::all;  ///< which of the scene's instances cast
  render::CameraView camera;
  vk::ImageView depth;   ///< the camera's depth (D32), in shader-read layout
  vk::ImageView normal;  ///< geometric world normals towards the camera, octahedral (RG16 snorm), in shader-read layout
  Light light;
  uint64_t index = 0;  ///< of the frame; per-frame buffers are used in turns of `frames_in_flight`
};

/// Bakes a precomputed shadow, as voxel::bake does: a caller may keep shadows for techniques to come, or bake on a
/// thread of its own. What it throws comes out of Technique::prepare.
using BakeShadow =
    std::function<voxel::VoxelShadow(const Scene&, const Light&, const voxel::BakeOptions&, const Progress&)>;

struct TechniqueOptions {
  uint32_t width = 0, height = 0;  ///< of the camera's buffers and the visibility image, pixels
  uint32_t frames_in_flight = 2;
  bool allow_readback = true;       ///< false: techniques that would wait for the device in `prepare` are refused
  const Scene* scene = nullptr;     ///< what precomputed shadows are baked from
  Progress progress = no_progress;  ///< of a bake
  BakeShadow bake = {};             ///< null: voxel::bake
};

/// Named results of a frame: one number or several ("effective_resolution": 2048, 2048).
using Counters = std::map<std::string, std::vector<double>>;

/// For the oracle: per pixel, row by row, the point from which the light must be seen (x infinite: lit without asking;
/// no points for filters that ask more than one texel), and a texel's half extents on the receiver. World space.
struct OracleRays {
  std::vector<glm::vec3> origins, texel_u, texel_v;
};

class Technique {
 public:
  virtual ~Technique() = default;

  /// Finds matrices and whatever else the frame needs. May submit and wait (then the camera's buffers must be
  /// complete), unless readback was forbidden: then a Recorder of the caller's command buffer will do. The frame that
  /// used this slot before (`index` less `frames_in_flight`) must have finished on the device. InputError for a light
  /// or camera that this technique can't serve.
  virtual void prepare(const Frame& frame, gpu::Recorder& recorder) = 0;
  /// Records map and look-up; never submits or waits. The visibility image is left in shader-read layout.
  virtual void record(const Frame& frame, gpu::Recorder& recorder) = 0;
  /// The same into a command buffer of the caller's, which has been begun, outside of any rendering. The camera's
  /// buffers must be visible to compute shaders there; the visibility image is, to every later command, when this
  /// returns.
  void record(const Frame& frame, VkCommandBuffer commands);

  /// True if `prepare` submits and waits.
  virtual bool needs_readback() const { return false; }
  /// R8, 1 = lit, of the size in the options. Pixels without geometry are lit, faces turned away are not.
  virtual gpu::Image& visibility() = 0;
  virtual std::vector<Allocation> allocations() const = 0;
  /// Figures of the last recorded frame, once it has finished. Some ask the device for them and wait.
  virtual Counters counters() const { return {}; }

  /// The views of the last prepared frame.
  virtual std::span<const MapView> views() const { return {}; }
  /// Layout of the set that a caller's casters, and shaders that include the look-up, bind; null where there is none.
  virtual vk::DescriptorSetLayout lookup_layout() const { return {}; }
  /// That set for `frame`.
  virtual vk::DescriptorSet lookup_set(const Frame&) const { return {}; }
  /// Paths below the installed GLSL folder to include, in this order, for map_caster (first) and
  /// `float filter_visible(vec3 world, vec4 plane)` (all): 1 where a point is lit that lies on a surface of this plane
  /// (dot(xyz, point) + w = 0), whose normal faces the light; of "precomputed" without what casters move. For filter
  /// "aa" set filter_step_x and filter_step_y before: how far a step of one pixel moves the point over its plane.
  virtual std::vector<std::string> lookup_includes() const { return {}; }
  /// Macros to define before those. From the first prepared frame on.
  virtual std::vector<std::string> lookup_defines() const { return {}; }
  /// Values of the specialization constants 0, 1, ... that they use, for the light of the last prepared frame.
  /// Constants of maps (0: the light's kind; 2 and 3: choices of the storage's and of the
  /// parameterization's) may stay unset: then the shader serves any light and asks for these at run time, which is
  /// slower. That of "precomputed" holds its filter's size, which is 1 voxel where it stays unset. A shader's own
  /// constants begin at 4.
  virtual std::vector<uint32_t> lookup_constants() const { return {}; }

  /// Reads the oracle's rays of the last recorded frame back and waits; none for techniques without texels.
  virtual std::optional<OracleRays> oracle_rays(const Frame&) { return std::nullopt; }

  /// Pictures that show how the technique works, by name, of the last recorded frame, whose camera's buffers must still
  /// be there. InputError for an unknown name.
  virtual std::vector<std::string> debug_names() const { return {}; }
  virtual Picture debug_picture(std::string_view name);

 protected:
  explicit Technique(const gpu::Device& device) : device_(device) {}
  const gpu::Device& device_;
};

/// True if the technique that `spec` names serves lights of this kind.
bool serves(const Spec& spec, LightKind light);

/// InputError where that technique can't serve `light`, or where the file that it names (which is opened) does not fit
/// the spec, the scene and the light: what else would come to light after long work. `ray` always passes.
void check(const Spec& spec, const Scene& scene, const Light& light);

/// Builds the technique that `spec` names. InputError where the options forbid what it needs.
std::unique_ptr<Technique> make_technique(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options);

}  // namespace shadewright::shadow
