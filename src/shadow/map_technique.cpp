#include "shadow/map_technique.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "render/shared.h"
#include "shadewright/error.h"
#include "shadow/lookup_data.h"
#include "shadow/lookup_shaders.h"
#include "shadow/parts.h"
#include "shadow/receiver_words.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

namespace {

/// MapViewData::slope_unit. Under a perspective light a texel grows with the distance and a depth's step with its
/// square: the mean of the map's near and far end is taken.
float slope_unit(const glm::dmat4& world_from_map, const MapExtent& extent) {
  const auto world = [&](const glm::dvec3& map) {
    const glm::dvec4 q = world_from_map * glm::dvec4(map, 1.0);
    return glm::dvec3(q) / q.w;
  };
  const auto unit_at = [&](double depth) {
    const glm::dvec3 middle(0.5, 0.5, depth), texel(1.0 / extent.width, 1.0 / extent.height, 1e-4);
    const auto step = [&](const glm::dvec3& by) { return glm::distance(world(middle + by), world(middle - by)); };
    const double width = std::sqrt(step({texel.x, 0, 0}) * step({0, texel.y, 0}));
    return width / step({0, 0, texel.z}) * texel.z;
  };
  return static_cast<float>(std::sqrt(unit_at(0.001) * unit_at(0.999)));
}

}  // namespace

MapTechnique::MapTechnique(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options)
    : Technique(device), spec_(spec), options_(options) {
  parameterization_ = make_parameterization(device, spec, options);
  if (!options.allow_readback && needs_readback())
    throw InputError(spec.text, "this technique waits for the device in every frame",
                     fmt::format("allow readback, or {}", parameterization_->traits().without_readback));

  visibility_ = make_visibility(device, options);
  sampler_ = gpu::make_sampler(device, vk::Filter::eNearest);
  for (uint32_t i = 0; i < options.frames_in_flight; ++i) {
    cameras_.emplace_back(device, "shadow camera", sizeof(shared::CameraData), gpu::HostAccess::write);
    lookups_.emplace_back(device, "shadow constants", sizeof(shared::LookupUniform), gpu::HostAccess::write);
  }
  // Constants and views, the parameterization's resources and the storage's: see map_point.glsl and the modules' GLSL.
  using enum gpu::BindingKind;
  const LookupSets::Part parts[] = {{0, {uniform_buffer}},
                                    {parameterization_binding, parameterization_->lookup_kinds()},
                                    {storage_binding, storage_traits(spec.storage).lookup_kinds}};
  lookup_sets_ = LookupSets(device, parts, options.frames_in_flight);
}

void MapTechnique::write_lookup_sets() {
  using gpu::Binding;
  for (uint32_t i = 0; i < options_.frames_in_flight; ++i) {
    gpu::write_set(device_, lookup_sets_.set(i), 0, std::array{Binding::uniform(lookups_[i])});
    gpu::write_set(device_, lookup_sets_.set(i), parameterization_binding, parameterization_->lookup_bindings(i));
    gpu::write_set(device_, lookup_sets_.set(i), storage_binding, storage_->lookup_bindings());
  }
}

void MapTechnique::build_for(LightKind light) {
  if (built_for_ == light) return;
  device_.handle().waitIdle();  // earlier frames may still read the old map
  built_for_.reset();           // until all has been made
  storage_.reset();
  draws_ = parameterization_->make_caster_draws(light, options_.frames_in_flight);
  storage_ = make_storage(device_, {spec_, parameterization_->map_extent(light), *draws_, lookup_sets_.layout()});
  lookup_ = LookupPasses(device_, spec_, {options_.width, options_.height}, lookup_sets_.layout(), shared_kind(light),
                         {storage_->lookup_constant(), parameterization_->lookup_constant()});
  built_for_ = light;
  write_lookup_sets();
}

void MapTechnique::prepare(const Frame& frame, gpu::Recorder& recorder) {
  check_light(spec_.parameterization, frame.light.kind);
  if (frame.draw_casters && !storage_traits(spec_.storage).takes_callbacks)
    throw InputError(fmt::format("storage '{}'", spec_.storage),
                     "it draws triangles by a pipeline of its own, not by a callback",
                     "put the casters into the scene, or choose depth storage");
  parameterization_->prepare(frame, recorder);
  build_for(frame.light.kind);
  recorder.cpu_stage("shadow constants", [&] {
    write_constants(frame);
    draws_->prepare(frame, slot(frame), parameterization_->views());
  });
  last_ = receiver_lookup(frame);
  parameterization_->refine(frame, last_, recorder, [&] { draw(frame, recorder); });
}

void MapTechnique::write_constants(const Frame& frame) {
  const uint32_t i = slot(frame);
  cameras_[i].mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
  const auto views = parameterization_->views();
  auto& constants = lookups_[i].mapped<shared::LookupUniform>()[0];
  const MapExtent extent = parameterization_->map_extent(frame.light.kind);
  for (size_t v = 0; v < views.size(); ++v) {
    const glm::dmat4 to_map = map_from_world(views[v]);
    const glm::dmat4 world_from_map = glm::inverse(to_map);
    constants.map_views[v] = {glm::mat4(to_map), glm::mat4(world_from_map), views[v].drawn ? 1u : 0u,
                              slope_unit(world_from_map, extent)};
  }
  shared::LookupData lookup = lookup_data(frame);
  lookup.bias_scale = static_cast<float>(spec_.number("bias"));
  lookup.map_size = glm::vec2(extent.width, extent.height);
  if (spec_.takes("radius")) {
    lookup.pcf_radius = static_cast<float>(spec_.number("radius") + 0.5);
    lookup.pcf_width = static_cast<float>(0.5 * spec_.number("width"));
  }
  if (spec_.takes("bleeding")) lookup.light_bleeding = static_cast<float>(spec_.number("bleeding"));
  storage_->write_lookup(lookup);
  constants.lookup = lookup;
}

ReceiverLookup MapTechnique::receiver_lookup(const Frame& frame) const {
  using gpu::Binding;
  const std::vector receivers{Binding::uniform(cameras_[slot(frame)]), Binding::sampled(frame.depth, *sampler_),
                              Binding::sampled(frame.normal, *sampler_)};
  return {lookup_sets_.layout(), lookup_set(frame), receivers,
          options_.width,        options_.height,   shared_kind(frame.light.kind)};
}

void MapTechnique::draw(const Frame& frame, gpu::Recorder& recorder) {
  draws_->cull(frame, slot(frame), last_, recorder);
  storage_->record(frame, last_.set, recorder);
}

void MapTechnique::record(const Frame& frame, gpu::Recorder& recorder) {
  parameterization_->record(frame, last_, recorder);
  draw(frame, recorder);
  recorder.stage("look-up", [&](const vk::raii::CommandBuffer& commands) {
    lookup_.record(commands, last_.receivers, last_.set, visibility_);
  });
}

std::vector<Allocation> MapTechnique::allocations() const {
  std::vector<Allocation> result{visibility_.allocation()};
  const auto append = [&](std::vector<Allocation> more) {
    for (auto& allocation : more) result.push_back(std::move(allocation));
  };
  if (storage_) {
    append(storage_->allocations());
    append(draws_->allocations());
  }
  append(parameterization_->allocations());
  append(lookup_.allocations());
  for (const auto* buffers : {&cameras_, &lookups_})
    for (const auto& buffer : *buffers) result.push_back(buffer.allocation());
  return result;
}

std::vector<std::string> MapTechnique::lookup_includes() const {
  const auto path = [](const std::string& axis, const std::string& name) {
    return "shadow/" + axis + "/" + name + "/" + name + ".glsl";
  };
  return {path("parameterization", spec_.parameterization), path("storage", spec_.storage),
          path("filter", spec_.filter)};
}

std::vector<uint32_t> MapTechnique::lookup_constants() const {
  if (!built_for_) return {};
  return {shared_kind(*built_for_), 0, storage_->lookup_constant(), parameterization_->lookup_constant()};
}

std::optional<OracleRays> MapTechnique::oracle_rays(const Frame& frame) {
  const auto answers =
      receiver_answers(device_, oracle_shader(spec_.parameterization), receiver_lookup(frame), 3, sizeof(glm::vec3));
  const auto points = [](const std::vector<std::byte>& bytes) {
    std::vector<glm::vec3> values(bytes.size() / sizeof(glm::vec3));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  };
  const bool one_texel_answers = spec_.storage == "depth" && spec_.filter == "hard";
  return OracleRays{one_texel_answers ? points(answers[0]) : std::vector<glm::vec3>{}, points(answers[1]),
                    points(answers[2])};
}

std::vector<uint32_t> MapTechnique::last_decisions() const {
  return receiver_words(device_, decisions_shader(spec_.parameterization + "/" + spec_.storage), last_);
}

Counters MapTechnique::counters() const {
  Counters counters = parameterization_->counters();
  if (storage_) {
    counters.merge(draws_->counters());
    counters.merge(storage_->counters());
  }
  if (const auto names = storage_traits(spec_.storage).decisions; built_for_ && !names.empty())
    counters.merge(decision_counters(last_decisions(), names));
  return counters;
}

std::vector<std::string> MapTechnique::debug_names() const {
  std::vector<std::string> names = parameterization_->debug_names();
  for (std::string& name : storage_traits(spec_.storage).debug_names) names.push_back(std::move(name));
  return names;
}

Picture MapTechnique::debug_picture(std::string_view name) {
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has(parameterization_->debug_names())) return parameterization_->debug_picture(name, last_);
  if (storage_ && has(storage_traits(spec_.storage).debug_names))
    return name == "decisions" ? decisions_picture(last_decisions(), last_.width, last_.height)
                               : storage_->debug_picture(name);
  return Technique::debug_picture(name);
}

}  // namespace shadewright::shadow
