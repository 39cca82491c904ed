#include "shadow/precomputed/precomputed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "render/shared.h"
#include "shaders/precomputed_address_double.h"
#include "shaders/precomputed_address_float.h"
#include "shaders/precomputed_image_double.h"
#include "shaders/precomputed_image_float.h"
#include "shaders/precomputed_windows_double.h"
#include "shaders/precomputed_windows_float.h"
#include "shadewright/error.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/file.h"
#include "shadow/lookup_data.h"
#include "shadow/precomputed/shared.h"

namespace shadewright::shadow {

namespace {

/// Words of a storage window.
constexpr uint64_t window_words = gpu::max_binding_bytes / sizeof(uint32_t);
constexpr uint32_t max_windows = 4, image_width = 16384;

/// The bits of precomputed.glsl's specialization constant, beside the taps.
enum Variant : uint32_t {
  variant_mraa = 0x100,
  variant_voaa = 0x200,
  variant_fixed_order = 0x400,
  variant_one_window = 0x800,
  variant_moving = 0x1000,
  variant_leaf_by_leaf = 0x2000
};

std::string direction_text(const glm::dvec3& v) {
  return fmt::format("({:.4f}, {:.4f}, {:.4f})", v.x, v.y, v.z);
}

std::string light_text(LightKind kind, const glm::dvec3& direction, const glm::dvec3& position) {
  const std::string along = fmt::format("along {}", direction_text(direction));
  return kind == LightKind::directional ? "a directional light " + along
                                        : fmt::format("a spot light at {} {}", direction_text(position), along);
}

/// A baked light must be the frame's; both are told where it is not.
void check_light_of_file(const voxel::LightGrid& baked, const Light& light, const std::string& file) {
  const glm::dvec3 direction = glm::normalize(light.direction), baked_direction = baked.direction();
  const bool turned = glm::length(direction - baked_direction) > 1e-4;
  const double scale = baked.kind == LightKind::spot ? baked.far : 1;
  const bool moved = baked.kind == LightKind::spot && glm::length(light.position - baked.position()) > 1e-4 * scale;
  if (baked.kind == light.kind && !turned && !moved) {
    const double tangent = 0.5 * baked.size() * std::max(baked.texel_size.x, baked.texel_size.y);
    if (baked.kind != LightKind::spot || tangent >= std::tan(light.outer_angle) * (1 - 1e-6)) return;
    throw InputError(file,
                     fmt::format("it holds a cone of {:.4g} degrees to each side, the scene's light has {:.4g}",
                                 glm::degrees(std::atan(tangent)), glm::degrees(light.outer_angle)),
                     "bake the scene's light");
  }
  throw InputError(file,
                   fmt::format("it holds the shadow of {}, but the scene's is {}",
                               light_text(baked.kind, baked_direction,
                                          baked.kind == LightKind::spot ? baked.position() : glm::dvec3(0)),
                               light_text(light.kind, direction, light.position)),
                   "bake the scene's light, or choose the baked one with --sun or --light");
}

/// Rows of the receivers' map: `real` is double, with the world's zero as origin, or float, with the eye's.
template <typename Real, typename Real4>
shared::ReceiverRows<Real, Real4> receiver_rows(const voxel::LightGrid& light, const glm::dvec3& eye) {
  shared::ReceiverRows<Real, Real4> rows{};
  glm::dmat4 voxel_from_relative = light.voxel_from_world;
  if constexpr (std::is_same_v<Real, float>) {
    rows.origin = glm::vec3(eye);
    voxel_from_relative[3] = light.voxel_from_world * glm::dvec4(glm::dvec3(rows.origin), 1.0);
    if (light.kind == LightKind::directional)
      for (int axis = 0; axis < 3; ++axis) {
        const double whole = std::clamp(std::floor(voxel_from_relative[3][axis]), -1e9, 1e9);
        rows.base[axis] = static_cast<int32_t>(whole);
        voxel_from_relative[3][axis] -= whole;
      }
  }
  for (int row = 0; row < 4; ++row) rows.voxel[row] = Real4(glm::row(voxel_from_relative, row));
  for (int row = 0; row < 3; ++row) rows.light[row] = Real4(glm::dvec4(glm::row(light.light_from_world, row), 0.0));
  rows.reach_x = static_cast<Real>(light.texel_size.x);
  rows.reach_y = static_cast<Real>(light.texel_size.y);
  rows.reach_z = static_cast<Real>(light.depth_at_unit_distance());
  return rows;
}

/// All DAGs' words one after the other, and where each part is.
std::vector<uint32_t> gather_words(const voxel::VoxelShadow& shadow, std::span<shared::DagPlace> places) {
  uint64_t count = 0;
  for (const voxel::DagView& dag : shadow.dags()) count += dag.grid.size() + dag.nodes.size() + 2 * dag.leaves.size();
  if (count > ~uint32_t{0})
    throw InputError("precomputed shadow", "it has more words than 32 bits can count", "bake at a lower resolution");
  std::vector<uint32_t> words;
  words.reserve(count);
  for (size_t i = 0; i < shadow.dags().size(); ++i) {
    const voxel::DagView& dag = shadow.dags()[i];
    const auto append = [&](auto part) {
      const auto offset = static_cast<uint32_t>(words.size());
      const auto* first = reinterpret_cast<const uint32_t*>(part.data());
      words.insert(words.end(), first, first + part.size_bytes() / sizeof(uint32_t));
      return offset;
    };
    places[i].log2_size = dag.log2_size;
    places[i].log2_grid = dag.log2_grid;
    places[i].grid = append(dag.grid);
    places[i].nodes = append(dag.nodes);
    places[i].leaves = append(dag.leaves);
  }
  return words;
}

/// What the spec asks of a look-up, `shadow` must have been baked for.
void check_use(const Spec& spec, const voxel::VoxelShadow& shadow) {
  const voxel::ShadowProperties& properties = shadow.properties();
  const std::string subject = fmt::format("spec '{}'", spec.text);
  if (spec.number("taps") > properties.max_filter)
    throw InputError(subject, fmt::format("the shadow was baked for filters up to {}", properties.max_filter),
                     "bake with a larger --max-filter");
  if (spec.choice("far") == "mraa" && shadow.dags().size() < 2)
    throw InputError(subject, "the shadow has no lower resolutions for far=mraa", "bake with --mraa, or use far=voaa");
  if (spec.nested("dynamic") && properties.static_receivers)
    throw InputError(subject, "a shadow baked for static receivers is undefined where moving ones can be",
                     "bake without --static");
}

voxel::VoxelShadow bake(const Spec& spec, const Light& light, const TechniqueOptions& technique) {
  voxel::BakeOptions options;
  options.resolution = spec.resolution;
  options.max_filter = static_cast<uint32_t>(spec.number("taps"));
  options.pyramid = spec.choice("far") == "mraa";
  options.static_receivers = spec.choice("static") == "1";
  const std::string closed = spec.choice("closed");
  options.closed = closed == "all"    ? voxel::ClosedMode::all
                   : closed == "none" ? voxel::ClosedMode::none
                                      : voxel::ClosedMode::automatic;
  voxel::VoxelShadow shadow = technique.bake ? technique.bake(*technique.scene, light, options, technique.progress)
                                             : voxel::bake(*technique.scene, light, options, technique.progress).shadow;
  check_use(spec, shadow);
  return shadow;
}

}  // namespace

voxel::VoxelShadow open_baked(const Spec& spec, const Scene* scene, const Light& light) {
  const std::string file = spec.choice("file");
  voxel::VoxelShadow shadow = voxel::open(file);
  if (scene) shadow = shadow.moved(-scene->origin);  // baked in the scene file's coordinates
  check_light_of_file(shadow.light(), light, file);
  if (spec.resolution != 0 && spec.resolution != shadow.light().size())
    throw InputError(fmt::format("spec '{}'", spec.text),
                     fmt::format("'{}' has {} voxels per axis", file, shadow.light().size()),
                     "leave the resolution out");
  check_use(spec, shadow);
  return shadow;
}

Precomputed::Precomputed(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options)
    : Technique(device), spec_(spec), options_(options) {
  if (spec.choice("file").empty() && !options.scene)
    throw InputError(spec.text, "there is neither a scene to bake nor a file", "give file=NAME.cpvs");
  const std::string precision = spec.choice("precision");
  if (precision == "double" && !device.has_double_precision())
    throw InputError(spec.text, "the device has no double precision", "leave precision=double out");
  double_precision_ =
      precision == "double" || (precision == "auto" && device.is_cpu() && device.has_double_precision());
  if (const auto dynamic = spec.nested("dynamic")) moving_ = make_technique(device, *dynamic, options);
  visibility_ = make_visibility(device, options);
  sampler_ = gpu::make_sampler(device, vk::Filter::eNearest);
  for (uint32_t i = 0; i < options.frames_in_flight; ++i) {
    const auto add = [&](std::vector<gpu::Buffer>& buffers, const char* name, size_t bytes) {
      buffers.emplace_back(device, name, bytes, gpu::HostAccess::write);
    };
    add(cameras_, "shadow camera", sizeof(shared::CameraData));
    add(constants_, "precomputed constants", sizeof(shared::PrecomputedUniform));
    add(rows_, "precomputed receivers", sizeof(shared::ReceiverRows<double, glm::dvec4>));
  }
}

Precomputed::~Precomputed() = default;

void Precomputed::prepare(const Frame& frame, gpu::Recorder& recorder) {
  if (!light_ || !same_light(*light_, frame.light)) bake_or_open(frame.light);
  if (moving_) {
    Frame moving = frame;
    moving.casters = render::InstanceFilter::moving;
    moving_->prepare(moving, recorder);
  }
  recorder.cpu_stage("shadow constants", [&] { write_constants(frame); });
}

void Precomputed::bake_or_open(const Light& light) {
  const auto start = std::chrono::steady_clock::now();
  voxel::VoxelShadow shadow =
      spec_.choice("file").empty() ? bake(spec_, light, options_) : open_baked(spec_, options_.scene, light);
  bake_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  use(std::move(shadow), light);
}

void Precomputed::use(voxel::VoxelShadow shadow, const Light& light) {
  device_.handle().waitIdle();  // earlier frames may still read the old words
  shadow_ = std::move(shadow);
  light_ = light;
  shared::PrecomputedData data{};
  const std::vector<uint32_t> words = gather_words(shadow_, data.dags);
  const voxel::LightGrid& grid = shadow_.light();
  data.texel_size = glm::vec2(grid.texel_size);
  data.depth = grid.depth();
  data.dag_count = static_cast<uint32_t>(shadow_.dags().size());
  for (const gpu::Buffer& buffer : constants_) buffer.mapped<shared::PrecomputedUniform>()[0].precomputed = data;
  access_ = choose_access(words.size());
  upload_words(words);
  make_sets();
  make_pass();
}

Precomputed::Access Precomputed::choose_access(uint64_t words) const {
  const bool fits_windows = words <= max_windows * window_words,
             fits_image = words <= uint64_t{image_width} * image_width;
  const std::string wish = spec_.choice("access");
  const auto refuse = [&](const char* limit) {
    throw InputError(spec_.text, fmt::format("its {} MB are more than {}", words >> 18, limit), "leave access out");
  };
  if (wish == "windows" && !fits_windows) refuse("four storage windows hold");
  if (wish == "image" && !fits_image) refuse("an image holds");
  if (wish == "windows" || (wish == "auto" && fits_windows)) return Access::windows;
  // Measured on a CPU device: an image costs a tenth more than a window, an address twice as much.
  if (wish == "image" || (wish == "auto" && device_.is_cpu() && fits_image)) return Access::image;
  return Access::address;
}

void Precomputed::upload_words(std::span<const uint32_t> words) {
  words_ = {};
  if (access_ == Access::image) {
    const auto rows = static_cast<uint32_t>((words.size() + image_width - 1) / image_width);
    words_.image = gpu::Image(device_, {"precomputed words", vk::Format::eR32Uint, image_width, rows, 1,
                                        vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    std::vector<uint32_t> padded(words.begin(), words.end());
    padded.resize(size_t{rows} * image_width);
    gpu::upload(device_, words_.image, std::as_bytes(std::span(padded)));
    return;
  }
  const uint64_t piece = access_ == Access::windows ? window_words : words.size();
  for (uint64_t first = 0; first < words.size(); first += piece)
    words_.buffers.push_back(gpu::make_buffer<uint32_t>(device_, "precomputed words",
                                                        words.subspan(first, std::min(piece, words.size() - first))));
  if (access_ == Access::address)
    words_.address = gpu::make_buffer<uint64_t>(device_, "precomputed address",
                                                std::array{words_.buffers.front().device_address(device_)});
}

std::vector<gpu::Binding> Precomputed::word_bindings() const {
  switch (access_) {
    case Access::image:
      return {gpu::Binding::sampled(words_.image.view(), *sampler_)};
    case Access::address:
      return {gpu::Binding::uniform(words_.address)};
    case Access::windows:
      break;
  }
  std::vector<gpu::Binding> windows;
  for (uint32_t i = 0; i < max_windows; ++i)
    windows.push_back(gpu::Binding::storage(words_.buffers[i < words_.buffers.size() ? i : 0]));
  return windows;
}

void Precomputed::make_sets() {
  using gpu::Binding;
  const auto bindings = [&](uint32_t i) {
    std::vector<Binding> all{Binding::uniform(constants_[i]), Binding::uniform(rows_[i])};
    for (const Binding& binding : word_bindings()) all.push_back(binding);
    return all;
  };
  LookupSets::Part part;
  for (const Binding& binding : bindings(0)) part.kinds.push_back(binding.kind);
  lookup_sets_ = LookupSets(device_, std::span(&part, 1), options_.frames_in_flight);
  for (uint32_t i = 0; i < options_.frames_in_flight; ++i) gpu::write_set(device_, lookup_sets_.set(i), 0, bindings(i));
}

void Precomputed::make_pass() {
  const auto shader = [&]() -> std::span<const uint32_t> {
    switch (access_) {
      case Access::image:
        return double_precision_ ? std::span<const uint32_t>(shaders::precomputed_image_double)
                                 : std::span<const uint32_t>(shaders::precomputed_image_float);
      case Access::address:
        return double_precision_ ? std::span<const uint32_t>(shaders::precomputed_address_double)
                                 : std::span<const uint32_t>(shaders::precomputed_address_float);
      case Access::windows:
        break;
    }
    return double_precision_ ? std::span<const uint32_t>(shaders::precomputed_windows_double)
                             : std::span<const uint32_t>(shaders::precomputed_windows_float);
  }();
  variant_ = static_cast<uint32_t>(spec_.number("taps"));
  if (spec_.choice("far") == "mraa") variant_ |= variant_mraa;
  if (spec_.choice("far") == "voaa") variant_ |= variant_voaa;
  // Measured on a CPU device: leaf by leaf takes a third less time than the best order.
  const std::string order = spec_.choice("order");
  if (order == "fixed") variant_ |= variant_fixed_order;
  if (order == "leaves" || (order == "auto" && device_.is_cpu())) variant_ |= variant_leaf_by_leaf;
  if (words_.buffers.size() == 1) variant_ |= variant_one_window;
  if (moving_) variant_ |= variant_moving;
  using enum gpu::BindingKind;
  const vk::DescriptorSetLayout layout = lookup_sets_.layout();
  pass_ =
      gpu::ComputePass(device_, shader, {uniform_buffer, sampled_image, sampled_image, storage_image, sampled_image}, 0,
                       std::span(&layout, 1), {variant_});
}

std::vector<std::string> Precomputed::lookup_defines() const {
  const char* const access_defines[] = {"PRECOMPUTED_WINDOWS", "PRECOMPUTED_IMAGE", "PRECOMPUTED_ADDRESS"};
  return {access_defines[static_cast<size_t>(access_)], double_precision_ ? "PRECOMPUTED_DOUBLE" : "PRECOMPUTED_FLOAT"};
}

void Precomputed::write_constants(const Frame& frame) {
  const uint32_t i = slot(frame);
  cameras_[i].mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
  auto& constants = constants_[i].mapped<shared::PrecomputedUniform>()[0];
  constants.lookup = lookup_data(frame);
  const glm::dvec3 eye = frame.camera.eye();
  const voxel::LightGrid& light = shadow_.light();
  if (double_precision_)
    rows_[i].mapped<shared::ReceiverRows<double, glm::dvec4>>()[0] = receiver_rows<double, glm::dvec4>(light, eye);
  else
    rows_[i].mapped<shared::ReceiverRows<float, glm::vec4>>()[0] = receiver_rows<float, glm::vec4>(light, eye);
  shared::PrecomputedData& data = constants.precomputed;
  const glm::dvec2 middle(0.5 * frame.camera.width, 0.5 * frame.camera.height);
  const glm::dvec3 across = frame.camera.ray(middle + glm::dvec2(1, 0)) - frame.camera.ray(middle),
                   down = frame.camera.ray(middle + glm::dvec2(0, 1)) - frame.camera.ray(middle),
                   cell = glm::cross(across, down);
  data.pixel_area = static_cast<float>(glm::length(cell));
  const glm::dvec3 axis = glm::normalize(cell);
  data.view_axis = glm::vec3(glm::dot(axis, frame.camera.ray(middle)) < 0 ? -axis : axis);
}

void Precomputed::record(const Frame& frame, gpu::Recorder& recorder) {
  if (moving_) {
    Frame moving = frame;
    moving.casters = render::InstanceFilter::moving;
    moving_->record(moving, recorder);
  }
  const vk::DescriptorSet set = lookup_set(frame);
  recorder.stage("look-up", [&](const vk::raii::CommandBuffer& commands) {
    visibility_.transition(commands, vk::ImageLayout::eGeneral, true);
    using gpu::Binding;
    const Binding bindings[] = {Binding::uniform(cameras_[slot(frame)]), Binding::sampled(frame.depth, *sampler_),
                                Binding::sampled(frame.normal, *sampler_), Binding::storage(visibility_.view()),
                                Binding::sampled(moving_ ? moving_->visibility().view() : frame.depth, *sampler_)};
    pass_.dispatch(commands, bindings, {}, {gpu::groups(options_.width, 8), gpu::groups(options_.height, 8), 1},
                   std::span(&set, 1));
    visibility_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
}

std::vector<Allocation> Precomputed::allocations() const {
  std::vector<Allocation> result{visibility_.allocation()};
  if (words_.image) result.push_back(words_.image.allocation());
  if (words_.address) result.push_back(words_.address.allocation());
  for (const auto* buffers : {&words_.buffers, &cameras_, &constants_, &rows_})
    for (const auto& buffer : *buffers) result.push_back(buffer.allocation());
  if (moving_)
    for (Allocation& allocation : moving_->allocations()) result.push_back(std::move(allocation));
  return result;
}

Counters Precomputed::counters() const {
  Counters counters = moving_ ? moving_->counters() : Counters{};
  const double size = light_ ? shadow_.light().size() : 0;
  counters["effective_resolution"] = {size, size};
  counters["dag_bytes"] = {static_cast<double>(shadow_.dag_bytes())};
  counters["grid_bytes"] = {static_cast<double>(shadow_.grid_bytes())};
  counters["bake_seconds"] = {bake_seconds_};
  return counters;
}

}  // namespace shadewright::shadow
