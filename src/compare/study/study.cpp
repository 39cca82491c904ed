#include "shadewright/compare/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "compare/difference.h"
#include "shadewright/compare/metrics.h"
#include "shadewright/raytrace/tracer.h"

namespace shadewright::compare {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Sums of stages by name over repeated frames.
class StageLog {
 public:
  void add(std::span<const gpu::StageTime> stages) {
    std::map<std::string, double> frame;
    double total = 0;
    for (const gpu::StageTime& stage : stages) {
      if (std::find(order_.begin(), order_.end(), stage.name) == order_.end()) order_.push_back(stage.name);
      frame[stage.name] += stage.milliseconds;
      total += stage.milliseconds;
    }
    for (const auto& [name, milliseconds] : frame) times_[name].push_back(milliseconds);
    totals_.push_back(total);
  }
  Timing timing() const {
    Timing timing;
    if (totals_.empty()) return timing;
    timing.median = median(totals_);
    timing.min = *std::min_element(totals_.begin(), totals_.end());
    timing.max = *std::max_element(totals_.begin(), totals_.end());
    for (const std::string& name : order_) timing.stages.push_back({name, median(times_.at(name))});
    return timing;
  }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> times_;
  std::vector<double> totals_;
};

std::vector<float> to_floats(std::span<const std::byte> bytes) {
  std::vector<float> values(bytes.size());
  std::transform(bytes.begin(), bytes.end(), values.begin(),
                 [](std::byte b) { return static_cast<float>(std::to_integer<uint8_t>(b)) / 255.0f; });
  return values;
}

}  // namespace

struct Study::Impl {
  const gpu::Device& device;
  const Scene& scene;
  Camera camera;
  Light light;
  StudyOptions options;
  Report report;

  render::SceneGpu scene_gpu;
  render::CameraView view;
  render::CameraPass camera_pass;
  std::vector<SurfacePoint> points;
  std::vector<uint8_t> albedo;
  std::unique_ptr<Tracer> tracer;
  std::vector<uint8_t> reference, facing;
  std::vector<float> filtered;

  Impl(const gpu::Device& device, const Scene& scene, const Camera& camera, const Light& light,
       const StudyOptions& options)
      : device(device),
        scene(scene),
        camera(camera),
        light(light),
        options(options),
        scene_gpu(device, scene),
        view(render::make_view(camera, near_distance(scene, camera), options.width, options.height)),
        camera_pass(scene_gpu, options.width, options.height, false) {}

  void draw_camera(const Progress& progress) {
    progress("camera pass", 0);
    // The picture's albedo is read from a pass of its own; the timed one has what techniques need and no more.
    render::CameraPass colored(scene_gpu, options.width, options.height, true);
    gpu::Recorder recorder(device);
    colored.record(recorder, view);
    recorder.finish();
    const auto bytes = gpu::read_back(device, colored.albedo(), 4);
    albedo.resize(bytes.size());
    std::memcpy(albedo.data(), bytes.data(), bytes.size());
    StageLog log;
    for (uint32_t i = 0; i <= options.repeat; ++i) {
      gpu::Recorder timed(device);
      camera_pass.record(timed, view);
      const auto stages = timed.finish();
      if (i > 0 || options.repeat == 0) log.add(stages);
    }
    points = camera_pass.surface_points(view);
    facing = facing_light(points, light);
    report.camera_pass_milliseconds = log.timing().median;
  }

  void trace(const Progress& progress) {
    progress("reference", 0.2);
    const glm::vec3 eye(camera.eye);
    tracer = std::make_unique<Tracer>(scene);
    reference = tracer->visible(points, eye, light, options.width);
    const auto start = Clock::now();
    reference = tracer->visible(points, eye, light, options.width);
    report.reference_milliseconds = milliseconds_since(start);
    size_t compared = 0, lit = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      compared += facing[i];
      lit += facing[i] && reference[i];
    }
    report.reference_lit_fraction = compared == 0 ? 0 : static_cast<double>(lit) / static_cast<double>(compared);
    progress("filtered reference", 0.5);
    if (options.reference_samples > 1)
      filtered = tracer->visible_supersampled(points, {options.width, options.height, camera}, light,
                                              options.reference_samples);
  }

  shadow::Frame frame() {
    shadow::Frame frame;
    frame.scene = &scene_gpu;
    frame.camera = view;
    frame.depth = camera_pass.depth().view();
    frame.normal = camera_pass.normal().view();
    frame.light = light;
    return frame;
  }

  void measure(Outcome& outcome, const shadow::OracleRays* oracle) const {
    if (!options.reference) return;
    MetricsInput input;
    input.width = options.width;
    input.height = options.height;
    input.points = points;
    input.eye = glm::vec3(camera.eye);
    input.facing = facing;
    input.visibility = outcome.visibility;
    input.reference = reference;
    input.reference_filtered = filtered;
    std::vector<uint8_t> perfect;
    if (oracle) {
      if (!oracle->origins.empty()) perfect = oracle_visibility(*oracle);
      input.oracle = perfect;
      input.texel_u = oracle->texel_u;
      input.texel_v = oracle->texel_v;
    }
    outcome.result.error = measure_error(input, *tracer, light);
    outcome.difference = difference_picture(input);
  }

  /// What a perfect map of this resolution would answer: free sight from the rays' origins to the light.
  std::vector<uint8_t> oracle_visibility(const shadow::OracleRays& oracle) const {
    std::vector<Segment> segments(oracle.origins.size());
    for (size_t i = 0; i < segments.size(); ++i) {
      const glm::vec3& origin = oracle.origins[i];
      if (!facing[i] || !std::isfinite(origin.x)) continue;
      if (light.kind == LightKind::directional)
        segments[i] = {origin, std::numeric_limits<float>::infinity(), -glm::vec3(light.direction), 1};
      else
        segments[i] = {origin, 1.0f, glm::vec3(light.position) - origin, 1};
    }
    return tracer->unoccluded(segments, options.width);
  }

  Outcome run_reference(const shadow::Spec& spec) {
    Outcome outcome;
    outcome.result.technique = spec.text;
    outcome.result.spec = spec.canonical();
    const double ms = report.reference_milliseconds;
    outcome.result.milliseconds = {ms, ms, ms, {{"shadow rays", ms}}};
    outcome.visibility.assign(reference.begin(), reference.end());
    return outcome;
  }

  Outcome run_technique(const shadow::Spec& spec, std::span<const std::string> debug) {
    const auto technique = shadow::make_technique(device, spec, {options.width, options.height, 1, true});
    const shadow::Frame current = frame();
    StageLog log;
    for (uint32_t i = 0; i <= options.repeat; ++i) {
      gpu::Recorder recorder(device);
      technique->prepare(current, recorder);
      technique->record(current, recorder);
      const auto stages = recorder.finish();
      if (i > 0 || options.repeat == 0) log.add(stages);  // the first frame compiles shaders
    }
    Outcome outcome;
    outcome.result.technique = spec.text;
    outcome.result.spec = spec.canonical();
    outcome.result.milliseconds = log.timing();
    outcome.result.memory = technique->allocations();
    outcome.result.counters = technique->counters();
    outcome.visibility = to_floats(gpu::read_back(device, technique->visibility(), 1));
    const auto oracle = options.reference ? technique->oracle_rays(current) : std::nullopt;
    measure(outcome, oracle ? &*oracle : nullptr);
    for (const std::string& name : debug) outcome.debug.push_back(technique->debug_picture(name));
    return outcome;
  }
};

Study::Study(const gpu::Device& device, const Scene& scene, const Camera& camera, const Light& light,
             const StudyOptions& options, const Progress& progress)
    : impl_(std::make_unique<Impl>(device, scene, camera, light, options)) {
  Report& report = impl_->report;
  report.scene_name = scene.name;
  report.triangles = triangle_count(scene);
  report.instances = scene.instances.size();
  report.device_name = device.info().name;
  report.device_type = gpu::to_string(device.info().type);
  report.width = options.width;
  report.height = options.height;
  report.camera = camera;
  report.camera.near = near_distance(scene, camera);
  report.light = light;
  impl_->draw_camera(progress);
  if (options.reference) impl_->trace(progress);
  progress("reference", 1);
}

Study::~Study() = default;

const Report& Study::report() const {
  return impl_->report;
}
void Study::add_notes(std::span<const std::string> notes) {
  impl_->report.notes.insert(impl_->report.notes.end(), notes.begin(), notes.end());
}
std::span<const SurfacePoint> Study::points() const {
  return impl_->points;
}
std::span<const uint8_t> Study::reference() const {
  return impl_->reference;
}

Outcome Study::run(const shadow::Spec& spec, std::span<const std::string> debug) {
  Outcome outcome = spec.parameterization == "ray" ? impl_->run_reference(spec) : impl_->run_technique(spec, debug);
  if (spec.parameterization == "ray") impl_->measure(outcome, nullptr);
  outcome.result.frame_milliseconds = outcome.result.milliseconds.median + impl_->report.camera_pass_milliseconds;
  return outcome;
}

std::vector<glm::vec3> Study::shade(std::span<const float> visibility) const {
  return render::shade(impl_->points, impl_->albedo, visibility, impl_->light, impl_->camera);
}

}  // namespace shadewright::compare
