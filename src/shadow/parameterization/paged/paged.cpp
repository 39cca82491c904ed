#include "shadow/parameterization/paged/paged.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <numeric>

#include "shaders/page_allocate_comp.h"
#include "shaders/page_counts_comp.h"
#include "shaders/page_edges_comp.h"
#include "shaders/page_invalidate_comp.h"
#include "shaders/page_levels_comp.h"
#include "shaders/page_picture_comp.h"
#include "shaders/page_plan_comp.h"
#include "shaders/page_requests_comp.h"
#include "shaders/page_statistics_comp.h"
#include "shaders/page_use_comp.h"
#include "shadewright/error.h"
#include "shadow/parameterization/paged/paged_caster_draws.h"
#include "shadow/parameterization/paged/superpage_caster_draws.h"
#include "shadow/parameterization/uniform/fit.h"
#include "shadow/receiver_words.h"

namespace shadewright::shadow {

namespace {

/// Refinement that has not come to rest by then is cut short; the paper's is not guaranteed to.
constexpr uint32_t max_iterations = 64;
constexpr uint32_t seed = 5;           // a level of 4^5 pages, 1,024^2 texels, from which refinement starts
constexpr uint32_t epochs = 1u << 11;  // the table's entries tell so many apart, see paged.glsl

/// 32-bit words of a bit a page.
uint32_t words_of(uint32_t top) {
  return shared::page_base(top + 1) / 32;
}

/// Receivers' bounds with the same width on both axes of the map, so that texels are square.
Box squared(Box box) {
  if (box.empty()) return box;
  const double half = 0.5 * std::max(box.size().x, box.size().y);
  const glm::dvec2 center(box.center());
  box.min = {center.x - half, center.y - half, box.min.z};
  box.max = {center.x + half, center.y + half, box.max.z};
  return box;
}

/// Half the width of what is read around a receiver, texels.
float footprint(const Spec& spec) {
  if (spec.storage == "subpixel") return 1.0f;
  return spec.filter == "trilinear" ? 0.5f : 0.0f;
}

/// A filter's taps lie up to a texel from what they ask for: a border of a texel of the coarsest level, a page, keeps
/// them all inside of the window of their view (or face: no tap needs another one), and so on pages that exist.
double border_texels(const Spec& spec) {
  return footprint(spec) > 0 ? spec.resolution / (shared::page_texels - 2.0) : 0;
}

uint32_t lod(const std::string& name) {
  if (name == "box") return shared::lod_box;
  if (name == "axis") return shared::lod_axis;
  return name == "area" ? shared::lod_area : shared::lod_bounded;
}

uint32_t sum(std::span<const uint32_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0u);
}

/// At how many levels a pixel asks for a page.
uint32_t levels_a_pixel(const Spec& spec) {
  return spec.filter == "trilinear" ? 2 : 1;
}

/// What is sorted is unique unless told otherwise; the host of the paper's CPU variants gets all that pixels ask for.
Uniquify uniquify(const Spec& spec) {
  const std::string name = spec.choice("uniquify");
  if (name == "auto") return spec.choice("analysis") == "cpu" ? Uniquify::none : Uniquify::full;
  if (name == "none") return Uniquify::none;
  if (name == "components") return Uniquify::components;
  return name == "compact" ? Uniquify::compact : Uniquify::full;
}

}  // namespace

Paged::Paged(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options)
    : device_(device),
      spec_(spec),
      frames_in_flight_(options.frames_in_flight),
      pool_texels_(static_cast<uint32_t>(spec.number("pool"))),
      cached_(spec.choice("cache") == "on"),
      edges_(spec.choice("refine") == "edges"),
      listed_(spec.choice("requests") == "sort" || spec.choice("uniquify") != "auto" ||
              spec.choice("analysis") == "cpu"),
      on_host_(spec.choice("analysis") == "cpu"),
      uniquify_(uniquify(spec)),
      bins_superpages_(spec.choice("draw") == "superpages"),
      changes_(device, options.frames_in_flight) {
  if (!std::has_single_bit(spec.resolution))
    throw InputError(spec.text, "a paged map's resolution is a power of two", "give 1024, 2048, ... 131072");
  if (pool_texels_ % (8 * shared::page_texels) != 0)
    throw InputError(spec.text, "the pool is no multiple of a block's 256 texels", "give 1024, 2048, 4096, ...");
  if (edges_ && spec.storage != "depth")
    throw InputError(spec.text, "edges are found in depths alone", "leave refine=edges out");
  if (bins_superpages_ && spec.storage != "depth")
    throw InputError(spec.text, "superpages are copied as depths alone", "leave draw=superpages out");
  if (listed_ && !RequestList::serves(options.width, options.height, levels_a_pixel(spec)))
    throw InputError(spec.text,
                     fmt::format("an image of {} x {} pixels asks for more pages than a list of {} MB holds",
                                 options.width, options.height, gpu::max_binding_bytes >> 20),
                     "leave requests, uniquify and analysis out, or give a smaller image");
  top_ = static_cast<uint32_t>(std::countr_zero(spec.resolution / shared::page_texels));
  analysis_scale_ = static_cast<uint32_t>(std::stoul(spec.choice("analysis_scale")));
  if (analysis_scale_ > 1 && (edges_ || listed_))
    throw InputError(spec.text, "only pixels that mark bits, without refinement, may be left out",
                     "give analysis_scale=1, or leave refine, requests, uniquify and analysis out");
  if (analysis_scale_ > 1 && spec.storage != "depth")
    throw InputError(spec.text, "a page that was left out would leave a hole in its neighbours' shadows",
                     "give analysis_scale=1");
  const auto finest = static_cast<uint32_t>(spec.number("finest"));
  if (!std::has_single_bit(finest))
    throw InputError(spec.text, "the finest level's resolution is a power of two",
                     "give finest=8192, 16384, 32768, ...");
  finest_ = finest < spec.resolution ? static_cast<uint32_t>(std::countr_zero(spec.resolution / finest)) : 0;
  words_ = words_of(top_);
  for (uint32_t i = 0; i < frames_in_flight_; ++i) {
    constants_.emplace_back(device, "page constants", sizeof(shared::PagedConstants), gpu::HostAccess::write);
    results_.emplace_back(device, "page counters", sizeof(shared::PageState), gpu::HostAccess::read);
    std::memset(results_.back().mapped<std::byte>().data(), 0, sizeof(shared::PageState));
  }
  if (spec.choice("statistics") == "on") used_ = used_texels_buffer();
  state_ = gpu::Buffer(device, "page state", sizeof(shared::PageState));
  using enum gpu::BindingKind;
  levels_pass_ = gpu::ComputePass(device, shaders::page_levels_comp,
                                  {uniform_buffer, storage_buffer, storage_buffer, storage_buffer, storage_buffer});
  plan_pass_ = gpu::ComputePass(device, shaders::page_plan_comp, {uniform_buffer, storage_buffer});
  counts_pass_ = gpu::ComputePass(device, shaders::page_counts_comp,
                                  {uniform_buffer, storage_buffer, storage_buffer, storage_buffer, storage_buffer,
                                   storage_buffer, storage_buffer, storage_buffer, storage_buffer});
}

MapExtent Paged::map_extent(LightKind) const {
  return {pool_texels_, pool_texels_, 1};
}

std::unique_ptr<CasterDraws> Paged::make_caster_draws(LightKind light, uint32_t) {
  make_tables(light);
  table_is_void_ = true;  // the pool is made anew too
  list_ = {};
  requests_pass_ = {};
  if (bins_superpages_) return std::make_unique<SuperpageCasterDraws>(device_, *this, frames_in_flight_);
  return std::make_unique<PagedCasterDraws>(device_, *this, light);
}

void Paged::make_tables(LightKind light) {
  const uint32_t faces = light == LightKind::point ? 6 : 1;
  if (faces == faces_) return;
  const uint64_t pages = uint64_t{words_} * 32 * faces;
  if (pages * sizeof(uint32_t) > device_.physical().getProperties().limits.maxStorageBufferRange)
    throw InputError(spec_.text, "the page table of a point light's six faces is larger than the device can bind",
                     "give a lower resolution");
  faces_ = faces;
  const uint32_t words = words_ * faces;
  requested_ = gpu::Buffer(device_, "requested pages", words * sizeof(uint32_t));
  requested_or_finer_ = gpu::Buffer(device_, "requested pages' parents", words * sizeof(uint32_t));
  placed_ = gpu::Buffer(device_, "placed pages", words * sizeof(uint32_t));
  valid_ = gpu::Buffer(device_, "valid pages", words * sizeof(uint32_t));
  draw_ = gpu::Buffer(device_, "pages to draw", words * sizeof(uint32_t));
  draw_or_finer_ = gpu::Buffer(device_, "parents of pages to draw", words * sizeof(uint32_t));
  counts_ = gpu::Buffer(device_, "page counts", words * sizeof(uint32_t));
  table_ = gpu::Buffer(device_, "page table", pages * sizeof(uint32_t));
  const uint64_t pool_pages = uint64_t{pool_texels_} * pool_texels_ / (shared::page_texels * shared::page_texels);
  emptied_ = gpu::Buffer(device_, "emptied pages", pool_pages * sizeof(uint32_t));
  if (bins_superpages_) {
    draw_on_host_ = gpu::Buffer(device_, "pages to draw on the host", words * sizeof(uint32_t), gpu::HostAccess::read);
    superpage_pages_.clear();
    for (uint32_t i = 0; i < frames_in_flight_; ++i)
      superpage_pages_.emplace_back(device_, "pages of superpages", pool_pages * sizeof(uint32_t),
                                    gpu::HostAccess::write);
  }
  scan_ = gpu::Scan(device_, words);
}

void Paged::prepare(const Frame& frame, gpu::Recorder& recorder) {
  slot_ = static_cast<uint32_t>(frame.index % frames_in_flight_);
  recorder.cpu_stage("fit", [&] {
    changes_.find(frame);
    // Kept pages stay where they are as long as what receives stays inside the map: what moves gets room for it.
    const bool moves = cached_ && frame.scene && !frame.scene->moving_instances().empty();
    if (!cached_ || changes_.all() || (changes_.any() && !fits(frame))) fit(frame, moves ? 0.1 : 0.0);
  });
  write_constants(frame);
}

void Paged::fit(const Frame& frame, double margin) {
  views_.clear();
  light_frames_.clear();
  held_.clear();
  for (const LightFrame& light : light_frames(frame.light)) {
    const std::vector<glm::dvec3> points = receiver_points(frame, window_planes(light));
    const LightFrame turned = turn_to_fit(light, points);
    Box box = squared(receiver_bounds(turned, points));
    if (!box.empty()) {
      const glm::dvec3 wider = margin * box.size();
      box.min -= wider;
      // The nearest receiver's z is negative, and stays so.
      box.max += light.perspective ? glm::dvec3(wider.x, wider.y, -margin * box.max.z) : wider;
    }
    MapView view = fit_view(turned, box, spec_.resolution, {border_texels(spec_), 0});
    view.casters = caster_planes(view, frame.camera, frame.light, false, {});
    views_.push_back(std::move(view));
    light_frames_.push_back(turned);
    held_.push_back(box);
  }
  new_fit_ = true;
}

bool Paged::fits(const Frame& frame) const {
  for (size_t i = 0; i < light_frames_.size(); ++i) {
    const LightFrame& light = light_frames_[i];
    const Box now = receiver_bounds(light, receiver_points(frame, window_planes(light)));
    if (!now.empty() && !(held_[i].contains(now.min) && held_[i].contains(now.max))) return false;
  }
  return true;
}

void Paged::write_constants(const Frame& frame) {
  shared::PagedConstants constants{};
  const render::CameraView& camera = frame.camera;
  const glm::dvec2 center = 0.5 * glm::dvec2(camera.width, camera.height);
  const glm::dvec3 ray = camera.ray(center);
  constants.pixel_x = glm::vec3(camera.ray(center + glm::dvec2(1, 0)) - ray);
  constants.pixel_y = glm::vec3(camera.ray(center + glm::dvec2(0, 1)) - ray);
  // View depth is what the w row of the camera's matrix tells; every ray's is 1.
  const glm::dvec3 w(camera.clip_from_world[0].w, camera.clip_from_world[1].w, camera.clip_from_world[2].w);
  constants.view_axis = glm::vec3(w / glm::dot(w, ray));
  constants.top = top_;
  constants.finest = finest_;
  constants.coarsest = edges_ || analysis_scale_ > 1 ? top_ - seed : top_;
  constants.faces = static_cast<uint32_t>(views_.size());
  constants.words = words_;
  constants.pool_width = pool_texels_ / shared::page_texels;
  constants.pool_pages = constants.pool_width * constants.pool_width;
  // The table's epochs run out: what the device told last is some frames old.
  table_is_void_ |= results_[slot_].mapped<shared::PageState>()[0].epoch + 2 * frames_in_flight_ >= epochs;
  constants.flush = !cached_ || new_fit_ || table_is_void_ ? 1 : 0;
  constants.blocks = bins_superpages_ ? 0 : 1;
  new_fit_ = false;
  constants.analysis_scale = analysis_scale_;
  constants.lod = lod(spec_.choice("lod"));
  constants.footprint = footprint(spec_);
  constants.footprint_levels = spec_.filter == "trilinear" ? 2 : 1;
  for (size_t face = 0; face < views_.size(); ++face) {
    // Casters count from a hundredth of the nearest receiver's distance on: depth is 0 there or clamped to it.
    const glm::dmat4& m = views_[face].light_from_world;
    const glm::dvec3 depth(m[0].z, m[1].z, m[2].z), distance(m[0].w, m[1].w, m[2].w);
    const double scale =
        glm::dot(distance, distance) > 0 ? glm::dot(depth, distance) / glm::dot(distance, distance) : 0;
    const double offset = m[3].z - scale * m[3].w;
    constants.near[face] = scale == 0 ? 0.5f : static_cast<float>(0.01 * -offset / scale);
  }
  constants_[slot_].mapped<shared::PagedConstants>()[0] = constants;
}

std::vector<gpu::BindingKind> Paged::lookup_kinds() const {
  using enum gpu::BindingKind;
  return {uniform_buffer, storage_buffer, storage_buffer};
}

std::vector<gpu::Binding> Paged::lookup_bindings(uint32_t slot) const {
  using gpu::Binding;
  return {Binding::uniform(constants_[slot]), Binding::storage(state_), Binding::storage(table_)};
}

void Paged::refine(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder,
                   const std::function<void()>& draw) {
  if (!waits()) return;
  make_passes(lookup);
  iterations_ = raw_requests_ = unique_requests_ = pages_drawn_ = 0;
  superpage_count_ = 0;
  list_counts_ = {};
  const auto& result = results_[slot_].mapped<shared::PageState>()[0];
  do {
    find_requests(frame, lookup, recorder, iterations_);
    if (!edges_ && !bins_superpages_) return;
    recorder.stage("page allocation",
                   [&](const vk::raii::CommandBuffer& commands) { record_allocation(lookup, commands); });
    if (bins_superpages_) find_superpages(recorder);
    if (!edges_) return;
    draw();
    recorder.wait();
    constants_[slot_].mapped<shared::PagedConstants>()[0].flush = 0;
    raw_requests_ += result.raw_requests;
    if (iterations_ > 0) unique_requests_ += sum(result.requested);
    pages_drawn_ += result.pages_drawn;
  } while (++iterations_ < max_iterations && (iterations_ == 1 || result.pages_drawn > 0));
}

void Paged::find_requests(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder,
                          uint32_t iteration) {
  const bool seeds = edges_ && iteration == 0;
  recorder.stage("page requests", [&](const vk::raii::CommandBuffer& commands) {
    empty_requests(commands);
    if (seeds || analysis_scale_ > 1) {
      record_seed(commands);
      gpu::memory_barrier(commands);
    }
    if (!seeds && !listed_) dispatch_pixels(edges_ ? edges_pass_ : requests_pass_, frame, lookup, commands);
  });
  if (!seeds && listed_) find_list(frame, lookup, recorder);
}

void Paged::find_list(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder) {
  if (!list_)
    list_ = RequestList(device_, {frame.camera.width, frame.camera.height, levels_a_pixel(spec_), words_ * 32 * faces_,
                                  uniquify_, on_host_, edges_, lookup.layout, lookup.light_kind});
  const RequestMasks masks{requested_, requested_or_finer_, state_};
  list_.find(lookup, masks, recorder);
  recorder.stage("page requests",
                 [&](const vk::raii::CommandBuffer& commands) { list_.mark(commands, constants_[slot_], masks); });
  list_counts_.listed += list_.counts().listed;
  list_counts_.compacted += list_.counts().compacted;
  list_counts_.unique += list_.counts().unique;
}

void Paged::record_seed(const vk::raii::CommandBuffer& commands) const {
  for (uint32_t face = 0; face < faces_; ++face) {
    const auto fill = [&](const gpu::Buffer& mask, uint32_t first, uint32_t count, uint32_t bits) {
      commands.fillBuffer(mask.handle(), (uint64_t{face} * words_ + first) * sizeof(uint32_t), count * sizeof(uint32_t),
                          bits);
    };
    fill(requested_, words_of(seed - 1), words_of(seed) - words_of(seed - 1), ~0u);
    fill(requested_or_finer_, 0, 1, 0x1);
    fill(requested_or_finer_, 1, 1, 0xf);
    fill(requested_or_finer_, 2, 1, 0xffff);
    fill(requested_or_finer_, 3, words_of(seed) - 3, ~0u);
  }
}

void Paged::record(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder) {
  make_passes(lookup);
  if (!waits()) find_requests(frame, lookup, recorder, 0);
  if (!edges_ && !bins_superpages_)
    recorder.stage("page allocation",
                   [&](const vk::raii::CommandBuffer& commands) { record_allocation(lookup, commands); });
  if (used_)
    recorder.stage("page statistics",
                   [&](const vk::raii::CommandBuffer& commands) { record_statistics(used_, lookup, commands); });
}

void Paged::make_passes(const ReceiverLookup& lookup) {
  if (requests_pass_) return;
  using enum gpu::BindingKind;
  const std::span layouts(&lookup.layout, 1);
  const auto of_pixels = [&](std::span<const uint32_t> spirv, size_t buffers) {
    std::vector kinds{uniform_buffer, sampled_image, sampled_image};
    kinds.insert(kinds.end(), buffers, storage_buffer);
    return gpu::ComputePass(device_, spirv, kinds, 0, layouts, {lookup.light_kind});
  };
  requests_pass_ = of_pixels(shaders::page_requests_comp, 3);
  if (edges_) edges_pass_ = of_pixels(shaders::page_edges_comp, 3);
  statistics_pass_ = of_pixels(shaders::page_statistics_comp, 2);
  allocate_pass_ = gpu::ComputePass(device_, shaders::page_allocate_comp, std::vector(9, storage_buffer), 0, layouts,
                                    {lookup.light_kind});
  invalidate_pass_ = gpu::ComputePass(device_, shaders::page_invalidate_comp, {storage_buffer, storage_buffer}, 0,
                                      layouts, {lookup.light_kind});
}

void Paged::empty_requests(const vk::raii::CommandBuffer& commands) {
  for (const gpu::Buffer* buffer : {&requested_, &requested_or_finer_, &draw_or_finer_})
    commands.fillBuffer(buffer->handle(), 0, VK_WHOLE_SIZE, 0);
  commands.fillBuffer(state_.handle(), 0, table_is_void_ ? VK_WHOLE_SIZE : offsetof(shared::PageState, epoch), 0);
  if (table_is_void_) commands.fillBuffer(table_.handle(), 0, VK_WHOLE_SIZE, 0);
  table_is_void_ = false;
  gpu::memory_barrier(commands);
}

void Paged::dispatch_pixels(const gpu::ComputePass& pass, const Frame& frame, const ReceiverLookup& lookup,
                            const vk::raii::CommandBuffer& commands) const {
  std::vector<gpu::Binding> all(lookup.receivers.begin(), lookup.receivers.end());
  for (const gpu::Buffer* buffer : {&requested_, &requested_or_finer_, &state_})
    all.push_back(gpu::Binding::storage(*buffer));
  pass.dispatch(commands, all, {}, {gpu::groups(frame.camera.width, 8), gpu::groups(frame.camera.height, 8), 1},
                std::span(&lookup.set, 1));
}

gpu::Buffer Paged::used_texels_buffer() const {
  return {device_, "used texels", uint64_t{pool_texels_} * pool_texels_ / 8};
}

void Paged::record_statistics(const gpu::Buffer& used, const ReceiverLookup& lookup,
                              const vk::raii::CommandBuffer& commands) const {
  commands.fillBuffer(used.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::memory_barrier(commands);
  std::vector<gpu::Binding> all(lookup.receivers.begin(), lookup.receivers.end());
  all.push_back(gpu::Binding::storage(state_));
  all.push_back(gpu::Binding::storage(used));
  statistics_pass_.dispatch(commands, all, {}, {gpu::groups(lookup.width, 8), gpu::groups(lookup.height, 8), 1},
                            std::span(&lookup.set, 1));
}

void Paged::record_allocation(const ReceiverLookup& lookup, const vk::raii::CommandBuffer& commands) {
  using gpu::Binding;
  const uint32_t words = words_ * faces_;
  const vk::Extent3D groups{gpu::groups(words, 64), 1, 1};
  const std::span sets(&lookup.set, 1);
  const Binding constants = Binding::uniform(constants_[slot_]), requested = Binding::storage(requested_),
                parents = Binding::storage(requested_or_finer_), state = Binding::storage(state_),
                placed = Binding::storage(placed_), valid = Binding::storage(valid_), draw = Binding::storage(draw_),
                counts = Binding::storage(counts_);
  if (cached_ && !changes_.boxes().empty()) {
    invalidate_pass_.dispatch(commands, std::array{Binding::storage(changes_.buffer(slot_)), valid}, {},
                              {static_cast<uint32_t>(changes_.boxes().size()), top_ + 1, faces_}, sets);
    gpu::memory_barrier(commands);
  }
  levels_pass_.dispatch(commands, std::array{constants, requested, parents, placed, state}, {}, groups);
  gpu::memory_barrier(commands);
  plan_pass_.dispatch(commands, std::array{constants, state}, {}, {1, 1, 1});
  gpu::memory_barrier(commands);
  counts_pass_.dispatch(
      commands, std::array{constants, requested, parents, placed, valid, state, draw, counts, Binding::storage(table_)},
      {}, groups);
  gpu::memory_barrier(commands);
  scan_.record(commands, counts_, words);
  gpu::memory_barrier(commands);
  allocate_pass_.dispatch(commands,
                          std::array{requested, draw, counts, placed, valid, Binding::storage(draw_or_finer_),
                                     Binding::storage(table_), state, Binding::storage(emptied_)},
                          {}, groups, sets);
}

void Paged::find_superpages(gpu::Recorder& recorder) {
  const uint32_t words = words_ * faces_;
  recorder.stage("pages to the host", [&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(draw_.handle(), draw_on_host_.handle(), vk::BufferCopy(0, 0, words * sizeof(uint32_t)));
  });
  recorder.wait();
  recorder.cpu_stage("superpages", [&] {
    bin_superpages(draw_on_host_.mapped<uint32_t>().first(words), words_, top_,
                   superpage_pages_[slot_].mapped<uint32_t>(), superpages_);
  });
  superpage_count_ += static_cast<uint32_t>(superpages_.size());
}

void Paged::record_results(const vk::raii::CommandBuffer& commands) const {
  commands.copyBuffer(state_.handle(), results_[slot_].handle(), vk::BufferCopy(0, 0, sizeof(shared::PageState)));
}

Counters Paged::counters() const {
  const auto& state = results_[slot_].mapped<shared::PageState>()[0];
  const auto number = [](uint32_t value) { return std::vector<double>{static_cast<double>(value)}; };
  const auto resolution = static_cast<double>(spec_.resolution >> state.finest);
  Counters counters{{"effective_resolution", {resolution, resolution}},
                    {"raw_requests", number(state.raw_requests)},
                    {"unique_requests", number(sum(state.requested))},
                    {"pages", number(state.pages)},
                    {"pages_drawn", number(state.pages_drawn)},
                    {"flushes", number(state.flushes)},
                    {"dropped_levels", number(state.finest - std::min(state.finest, finest_))},
                    {"triangle_page_pairs", number(state.pairs)},
                    {"clusters_not_drawn", number(state.late_clusters)}};
  if (bins_superpages_) counters["superpages"] = number(superpage_count_);
  if (listed_) {
    counters["listed_requests"] = number(list_counts_.listed);
    if (uniquify_ >= Uniquify::compact) counters["compacted_requests"] = number(list_counts_.compacted);
    if (uniquify_ == Uniquify::full) counters["sorted_unique_requests"] = number(list_counts_.unique);
  }
  if (edges_) {
    counters["iterations"] = number(iterations_);
    counters["raw_requests"] = number(raw_requests_);
    counters["unique_requests"] = number(unique_requests_);
    counters["pages"] = number(state.slots);
    counters["pages_drawn"] = number(pages_drawn_);
  }
  if (used_) {
    counters["taps"] = number(state.taps);
    counters["coarser_taps"] = number(state.coarser_taps);
    counters["unserved_taps"] = number(state.lost_taps);
    counters["page_utilization"] = {state.used_texels /
                                    std::max(1.0, 1.0 * state.slots * shared::page_texels * shared::page_texels)};
  }
  return counters;
}

Picture Paged::debug_picture(std::string_view name, const ReceiverLookup& lookup) {
  if (name == "page-use") return page_use(lookup);
  Picture picture{lookup.width, lookup.height, {}};
  for (const uint32_t word : receiver_words(device_, shaders::page_picture_comp, lookup))
    picture.pixels.push_back(std::bit_cast<glm::u8vec4>(word));
  return picture;
}

Picture Paged::page_use(const ReceiverLookup& lookup) const {
  using enum gpu::BindingKind;
  const gpu::ComputePass pass(device_, shaders::page_use_comp, {storage_buffer, storage_buffer}, 0,
                              std::span(&lookup.layout, 1), {lookup.light_kind});
  const uint32_t side = 1u << top_;
  Picture picture{side + side / 2, side * faces_, {}};
  picture.pixels.resize(size_t{picture.width} * picture.height);
  const uint64_t bytes = picture.pixels.size() * sizeof(glm::u8vec4);
  const gpu::Buffer used = used_texels_buffer(), colors(device_, "use of pages", bytes);
  gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(colors.handle(), 0, VK_WHOLE_SIZE, ~0u);
    record_statistics(used, lookup, commands);
    gpu::memory_barrier(commands);
    pass.dispatch(commands, std::array{gpu::Binding::storage(used), gpu::Binding::storage(colors)}, {},
                  {gpu::groups(words_ * faces_, 64), 1, 1}, std::span(&lookup.set, 1));
  });
  std::memcpy(picture.pixels.data(), gpu::read_back(device_, colors, bytes).data(), bytes);
  return picture;
}

std::vector<Allocation> Paged::allocations() const {
  std::vector<Allocation> result{state_.allocation()};
  if (table_)
    for (const gpu::Buffer* buffer : {&table_, &requested_, &requested_or_finer_, &placed_, &valid_, &draw_,
                                      &draw_or_finer_, &counts_, &emptied_, &scan_.totals()})
      result.push_back(buffer->allocation());
  for (const auto* buffers : {&constants_, &results_})
    for (const auto& buffer : *buffers) result.push_back(buffer.allocation());
  if (draw_on_host_) result.push_back(draw_on_host_.allocation());
  for (const auto& buffer : superpage_pages_) result.push_back(buffer.allocation());
  if (list_)
    for (auto& allocation : list_.allocations()) result.push_back(std::move(allocation));
  if (used_) result.push_back(used_.allocation());
  for (auto& allocation : changes_.allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
