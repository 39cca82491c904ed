// One camera's view of a scene, drawn: what tests look shadows up for.
#pragma once

#include "shadewright/render/camera_pass.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class ViewForTest {
 public:
  ViewForTest(const gpu::Device& device, const Scene& scene, const Camera& camera, uint32_t width, uint32_t height)
      : ViewForTest(device, scene, render::make_view(camera, near_distance(scene, camera), width, height)) {}

  ViewForTest(const gpu::Device& device, const Scene& scene, const render::CameraView& camera)
      : device_(device), scene_(device, scene), pass_(scene_, camera.width, camera.height, false) {
    frame_.scene = &scene_;
    frame_.camera = camera;
    gpu::Recorder recorder(device);
    pass_.record(recorder, frame_.camera);
    recorder.finish();
    frame_.depth = pass_.depth().view();
    frame_.normal = pass_.normal().view();
  }

  /// Without a light of the test's own.
  const Frame& frame() const { return frame_; }
  Frame& frame() { return frame_; }

  /// The visibility of each pixel, in steps of 1/255.
  std::vector<std::byte> look_up(Technique& technique) const {
    gpu::Recorder recorder(device_);
    technique.prepare(frame_, recorder);
    technique.record(frame_, recorder);
    recorder.finish();
    return gpu::read_back(device_, technique.visibility(), 1);
  }

 private:
  const gpu::Device& device_;
  render::SceneGpu scene_;
  render::CameraPass pass_;
  Frame frame_;
};

}  // namespace shadewright::shadow
