#include "compare/study/study_view.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "compare/study/stage_log.h"
#include "shadewright/compare/metrics.h"

namespace shadewright::compare {

StudyView::StudyView(const gpu::Device& device, const Scene& scene, const StudyOptions& options, double time)
    : device_(device),
      scene_(scene),
      options_(options),
      scene_gpu_(device, scene, time, 1),
      camera_pass_(scene_gpu_, options.width, options.height, false) {}

void StudyView::show(const Moment& moment, uint32_t repeat) {
  moment_ = moment;
  near_ = near_distance(scene_, moment.camera);
  view_ = render::make_view(moment.camera, near_, options_.width, options_.height);
  gpu::Recorder mover(device_);
  scene_gpu_.update(scene_, moment.time, 0, mover);
  mover.finish();
  StageLog log;
  for (uint32_t i = 0; i <= repeat; ++i) {
    gpu::Recorder recorder(device_);
    camera_pass_.record(recorder, view_);
    const auto stages = recorder.finish();
    if (i > 0 || repeat == 0) log.add(stages);
  }
  camera_milliseconds_ = log.timing().median;
  points_ = camera_pass_.surface_points(view_);
  facing_ = facing_light(points_, moment.light);
  albedo_.clear();
}

void StudyView::trace(bool repeat, const Progress& progress) {
  if (!options_.reference) return;
  progress("reference", 0.2);
  if (tracer_)
    tracer_->update(scene_, moment_.time);
  else
    tracer_ = std::make_unique<Tracer>(scene_, moment_.time);
  const glm::vec3 eye(moment_.camera.eye);
  for (int i = 0; i <= static_cast<int>(repeat); ++i) {
    const auto start = std::chrono::steady_clock::now();
    reference_ = tracer_->visible(points_, eye, moment_.light, options_.width);
    reference_milliseconds_ =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
  progress("filtered reference", 0.5);
  if (options_.reference_samples > 1)
    filtered_ = tracer_->visible_supersampled(points_, grid(), moment_.light, options_.reference_samples);
}

shadow::Frame StudyView::frame() {
  shadow::Frame frame;
  frame.scene = &scene_gpu_;
  frame.camera = view_;
  frame.depth = camera_pass_.depth().view();
  frame.normal = camera_pass_.normal().view();
  frame.light = moment_.light;
  return frame;
}

std::vector<glm::vec3> StudyView::shade(std::span<const float> visibility) {
  // The picture's albedo is drawn by a pass of its own; the timed one has what techniques need and no more.
  if (albedo_.empty()) {
    if (!colored_) colored_ = std::make_unique<render::CameraPass>(scene_gpu_, options_.width, options_.height, true);
    gpu::Recorder recorder(device_);
    colored_->record(recorder, view_);
    recorder.finish();
    const auto bytes = gpu::read_back(device_, colored_->albedo(), 4);
    albedo_.resize(bytes.size());
    std::memcpy(albedo_.data(), bytes.data(), bytes.size());
  }
  return render::shade(points_, albedo_, visibility, moment_.light, moment_.camera);
}

StudyView::LitCount StudyView::count_lit() const {
  LitCount count;
  for (size_t i = 0; i < reference_.size(); ++i) {
    count.compared += facing_[i];
    count.lit += facing_[i] && reference_[i];
  }
  return count;
}

Report StudyView::describe() const {
  Report report;
  report.scene_name = scene_.name;
  report.triangles = triangle_count(scene_);
  report.instances = scene_.instances.size();
  report.device_name = device_.info().name;
  report.device_type = gpu::to_string(device_.info().type);
  report.width = options_.width;
  report.height = options_.height;
  report.camera = moment_.camera;
  report.camera.near = near_;
  report.camera.eye += scene_.origin;
  report.camera.target += scene_.origin;
  report.light = moment_.light;
  report.light.position += scene_.origin;
  report.reference_milliseconds = reference_milliseconds_;
  report.camera_pass_milliseconds = camera_milliseconds_;
  const LitCount count = count_lit();
  if (count.compared > 0)
    report.reference_lit_fraction = static_cast<double>(count.lit) / static_cast<double>(count.compared);
  return report;
}

}  // namespace shadewright::compare
