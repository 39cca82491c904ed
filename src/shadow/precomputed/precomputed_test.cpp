// The look-up on the device against the CPU's, and against ray tracing with bodies that move.
#include "shadow/precomputed/precomputed.h"

#include <cmath>
#include <cstring>

#include "gpu/device_for_test.h"
#include "render/shared.h"
#include "shaders/receivers_for_test_comp.h"
#include "shadewright/error.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/file.h"
#include "shadow/lookup_data.h"
#include "shadow/view_for_test.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 320, height = 180;

/// A view that also tells its receivers.
class Stage : public ViewForTest {
 public:
  Stage(const gpu::Device& device, const Scene& scene, const Camera& camera, const Light& light)
      : ViewForTest(device, scene, camera, width, height), device_(device), scene_(scene) {
    frame().light = light;
  }

  std::unique_ptr<Precomputed> make(const std::string& spec) const {
    return std::make_unique<Precomputed>(device_, parse_spec(spec),
                                         TechniqueOptions{.width = width, .height = height, .scene = &scene_});
  }

  std::vector<uint8_t> look_up(Technique& technique) const {
    const auto bytes = ViewForTest::look_up(technique);
    std::vector<uint8_t> values(bytes.size());
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  /// The points that the look-up sees; those that do not face the light have a zero normal.
  std::vector<SurfacePoint> receivers() const {
    using enum gpu::BindingKind;
    const gpu::ComputePass pass(
        device_, shaders::receivers_for_test_comp,
        {uniform_buffer, sampled_image, sampled_image, storage_buffer, storage_buffer, uniform_buffer});
    const gpu::Buffer camera(device_, "camera", sizeof(shared::CameraData), gpu::HostAccess::write),
        lookup(device_, "lookup", sizeof(shared::LookupData), gpu::HostAccess::write);
    camera.mapped<shared::CameraData>()[0] = render::camera_data(frame().camera);
    lookup.mapped<shared::LookupData>()[0] = lookup_data(frame());
    const uint64_t bytes = uint64_t{width} * height * sizeof(glm::vec3);
    const gpu::Buffer positions(device_, "positions", bytes), normals(device_, "normals", bytes);
    const auto sampler = gpu::make_sampler(device_, vk::Filter::eNearest);
    gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
      using gpu::Binding;
      const Binding bindings[] = {Binding::uniform(camera),
                                  Binding::sampled(frame().depth, *sampler),
                                  Binding::sampled(frame().normal, *sampler),
                                  Binding::storage(positions),
                                  Binding::storage(normals),
                                  Binding::uniform(lookup)};
      pass.dispatch(commands, bindings, {}, {gpu::groups(width, 8), gpu::groups(height, 8), 1});
    });
    const auto read = [&](const gpu::Buffer& buffer) {
      std::vector<glm::vec3> values(size_t{width} * height);
      std::memcpy(values.data(), gpu::read_back(device_, buffer, bytes).data(), bytes);
      return values;
    };
    const auto where = read(positions), normal = read(normals);
    std::vector<SurfacePoint> points(where.size());
    for (size_t i = 0; i < points.size(); ++i) points[i] = {where[i], normal[i]};
    return points;
  }

 private:
  const gpu::Device& device_;
  const Scene& scene_;
};

class PrecomputedTest : public gpu::DeviceTest {
 protected:
  /// How many facing pixels differ from the CPU's answers.
  static size_t disagreements(std::span<const SurfacePoint> receivers, std::span<const float> cpu,
                              std::span<const uint8_t> device_answers) {
    size_t count = 0;
    for (size_t i = 0; i < receivers.size(); ++i)
      if (receivers[i].normal != glm::vec3(0))
        count += std::lround(cpu[i] * 255.0f) != static_cast<long>(device_answers[i]);
    return count;
  }
};

Scene small_city() {
  return make_builtin("city?triangles=20000");
}

Light spot_over(const Scene& scene) {
  Light lamp;
  lamp.kind = LightKind::spot;
  const Box box = bounds(scene);
  lamp.position = box.center() + glm::dvec3(0.2, 1.5, 0.1) * glm::length(box.size());
  lamp.direction = glm::normalize(box.center() - lamp.position);
  lamp.outer_angle = 0.5;
  return lamp;
}

TEST_F(PrecomputedTest, AgreesWithTheCpuOnEveryPixel) {
  const Scene scene = small_city();
  for (const Light& light : {scene.lights.front(), spot_over(scene)}) {
    const Stage stage(device(), scene, scene.cameras.front(), light);
    const auto receivers = stage.receivers();
    for (const uint32_t taps : {1u, 3u, 9u, 17u}) {
      const auto technique = stage.make("cpvs@4096,precision=double,taps=" + std::to_string(taps));
      const auto answers = stage.look_up(*technique);
      std::vector<float> expected(receivers.size());
      technique->shadow().visibility(receivers, taps, expected);
      EXPECT_EQ(disagreements(receivers, expected, answers), 0u) << taps << " taps, light kind " << int(light.kind);
    }
  }
}

TEST_F(PrecomputedTest, AllWaysToReadTheWordsAndToWalkAnswerTheSame) {
  const Scene scene = small_city();
  const Stage stage(device(), scene, scene.cameras.back(), scene.lights.front());
  const auto expected = stage.look_up(*stage.make("cpvs@2048,taps=17"));
  for (const char* key : {"access=image", "access=address", "order=fixed", "order=best", "order=leaves"})
    EXPECT_EQ(stage.look_up(*stage.make(std::string("cpvs@2048,taps=17,") + key)), expected) << key;
  const auto rounded = stage.look_up(*stage.make("cpvs@2048,taps=17,precision=float"));
  size_t different = 0;
  for (size_t i = 0; i < expected.size(); ++i) different += rounded[i] != expected[i];
  EXPECT_LE(different, expected.size() / 500);
}

/// `shadow` with `words` unused words before its nodes.
voxel::VoxelShadow padded(const voxel::VoxelShadow& shadow, uint32_t words) {
  struct Data {
    std::vector<uint32_t> grid, nodes;
  };
  const voxel::DagView& dag = shadow.dags()[0];
  const auto data = std::make_shared<Data>();
  data->grid.assign(dag.grid.begin(), dag.grid.end());
  for (uint32_t& cell : data->grid)
    if (cell > voxel::kVisible) cell += words;
  data->nodes.resize(words);
  data->nodes.insert(data->nodes.end(), dag.nodes.begin(), dag.nodes.end());
  const auto starts = shadow.level_starts(0);
  for (uint64_t at = starts.front(); at < starts[starts.size() - 2];) {  // the last height points to leaves
    const uint32_t count = voxel::node_words(dag.nodes[at]);
    for (uint64_t pointer = at + 1; pointer < at + count; ++pointer) data->nodes[words + pointer] += words;
    at += count;
  }
  const voxel::DagView moved{dag.log2_size, dag.log2_grid, data->grid, data->nodes, dag.leaves};
  std::vector<uint64_t> moved_starts(starts.begin(), starts.end());
  for (uint64_t& start : moved_starts) start += words;
  return {shadow.properties(),
          {moved},
          {moved_starts},
          std::make_shared<std::pair<std::shared_ptr<Data>, voxel::VoxelShadow>>(data, shadow)};
}

TEST_F(PrecomputedTest, ReadsDagsLargerThanOneWindow) {
  const Scene scene = small_city();
  const Stage stage(device(), scene, scene.cameras.front(), scene.lights.front());
  const auto small = stage.make("cpvs@2048,taps=9");
  const auto expected = stage.look_up(*small);
  const voxel::VoxelShadow large = padded(small->shadow(), 40u << 20);  // 160 MB
  for (const char* access : {"windows", "image", "address"}) {
    const auto technique = stage.make(std::string("cpvs@2048,taps=9,access=") + access);
    technique->use(large, stage.frame().light);
    EXPECT_EQ(stage.look_up(*technique), expected) << access;
  }
}

TEST_F(PrecomputedTest, DistantReceiversAgreeWithTheCpu) {
  const Scene scene = small_city();
  Camera far = scene.cameras.front();
  far.eye = far.target + (far.eye - far.target) * 4.0;
  const Stage stage(device(), scene, far, scene.lights.front());
  const auto receivers = stage.receivers();
  const render::CameraView& view = stage.frame().camera;
  const glm::dvec3 eye = view.eye(), axis = glm::normalize(far.target - far.eye),
                   light = glm::normalize(scene.lights.front().direction);
  const double cell = glm::length(glm::cross(view.ray({1, 0}) - view.ray({0, 0}), view.ray({0, 1}) - view.ray({0, 0})));
  std::vector<float> footprints(receivers.size());
  for (size_t i = 0; i < receivers.size(); ++i) {
    const glm::dvec3 from_eye = glm::dvec3(receivers[i].position) - eye, normal(receivers[i].normal);
    const double depth = glm::dot(from_eye, axis);
    const double area = cell * depth * depth * glm::dot(glm::normalize(from_eye), axis) /
                        std::abs(glm::dot(glm::normalize(from_eye), normal)) * std::abs(glm::dot(light, normal));
    footprints[i] = static_cast<float>(std::sqrt(area));
  }
  for (const auto& [name, how] : {std::pair{"mraa", voxel::Distant::mraa}, {"voaa", voxel::Distant::voaa}}) {
    const auto technique = stage.make(std::string("cpvs@16384,taps=3,far=") + name);
    const auto answers = stage.look_up(*technique);
    std::vector<float> expected(receivers.size());
    technique->shadow().distant_visibility(receivers, footprints, 3, how, expected);
    size_t facing = 0, different = 0;
    for (size_t i = 0; i < receivers.size(); ++i) {
      if (receivers[i].normal == glm::vec3(0)) continue;
      ++facing;
      different += std::abs(expected[i] * 255.0f - static_cast<float>(answers[i])) > 2.0f;
    }
    ASSERT_GT(facing, 1000u);
    EXPECT_LE(different, facing / 200) << name;  // sizes right at a step between two levels
  }
}

/// Wrong pixels of `spec` among those that face the light.
size_t wrong_pixels(const Stage& stage, const Scene& scene, const std::string& spec) {
  const auto receivers = stage.receivers();
  const auto truth =
      Tracer(scene).visible(receivers, glm::vec3(stage.frame().camera.eye()), stage.frame().light, width);
  const auto answers = stage.look_up(*stage.make(spec));
  size_t count = 0;
  for (size_t i = 0; i < receivers.size(); ++i)
    if (receivers[i].normal != glm::vec3(0)) count += (answers[i] >= 128) != (truth[i] != 0);
  return count;
}

TEST_F(PrecomputedTest, MovingBodiesCastAndReceive) {
  const Scene scene = make_builtin("street");
  const Stage stage(device(), scene, find_camera(scene, "overview"), scene.lights.front());
  const size_t with_moving = wrong_pixels(stage, scene, "cpvs@8192,dynamic=(sm@4096)");
  EXPECT_LE(with_moving, size_t{width} * height / 100);
  EXPECT_LT(2 * with_moving, wrong_pixels(stage, scene, "cpvs@8192"));
}

/// A board that hovers over the ground camera's mountains: it shades them, and they may shade it.
TEST_F(PrecomputedTest, ABodyMovesThroughALandscape) {
  Scene scene = make_builtin("landscape?triangles=20000");
  const Camera& camera = scene.cameras.front();
  const glm::dvec3 ahead = camera.eye + 0.5 * (camera.target - camera.eye) + glm::dvec3(0, 14, 0);
  Mesh board;
  board.positions = {{-12, 0, -12}, {12, 0, -12}, {12, 0, 12}, {-12, 0, 12}};
  board.triangles = {{0, 2, 1}, {0, 3, 2}};
  Motion motion;
  motion.times = {0, 1};
  motion.translations = {ahead, ahead + glm::dvec3(5, 0, 0)};
  motion.rotations = {glm::dquat(1, 0, 0, 0), glm::dquat(1, 0, 0, 0)};
  Instance instance;
  instance.mesh = static_cast<uint32_t>(scene.meshes.size());
  instance.motion = static_cast<uint32_t>(scene.motions.size());
  scene.meshes.push_back(board);
  scene.motions.push_back(motion);
  scene.instances.push_back(instance);
  const Stage stage(device(), scene, camera, scene.lights.front());
  const size_t without = wrong_pixels(stage, scene, "cpvs@16384");
  EXPECT_GT(without, 200u);
  EXPECT_LT(10 * wrong_pixels(stage, scene, "cpvs@16384,dynamic=(csm@2048)"), without);
}

TEST_F(PrecomputedTest, BakesAnewForAnotherSun) {
  const Scene scene = make_builtin("spheres");
  Stage stage(device(), scene, scene.cameras.front(), sun(150, 48));
  const auto technique = stage.make("cpvs@256");
  const auto first = stage.look_up(*technique);
  stage.frame().light = sun(60, 48);
  EXPECT_EQ(stage.look_up(*technique), stage.look_up(*stage.make("cpvs@256")));
  EXPECT_NE(stage.look_up(*technique), first);
}

TEST_F(PrecomputedTest, RefusesFilesOfANarrowerCone) {
  Scene scene = make_builtin("chess");
  Light& light = scene.lights.front();
  ASSERT_EQ(light.kind, LightKind::spot);
  const std::string file = testing::TempDir() + "precomputed_cone_test.cpvs";
  voxel::BakeOptions options;
  options.resolution = 64;
  voxel::save(voxel::bake(scene, light, options).shadow, file);
  EXPECT_NO_THROW(check(parse_spec("cpvs,file=" + file), scene, light));
  light.outer_angle *= 1.1;
  EXPECT_THROW(check(parse_spec("cpvs,file=" + file), scene, light), InputError);
  light.outer_angle *= 0.5;
  EXPECT_NO_THROW(check(parse_spec("cpvs,file=" + file), scene, light)) << "the baked one holds it";
  std::remove(file.c_str());
}

TEST_F(PrecomputedTest, RefusesFilesOfAnotherLight) {
  const Scene scene = make_builtin("spheres");
  const std::string file = testing::TempDir() + "precomputed_test.cpvs";
  voxel::BakeOptions options;
  options.resolution = 256;
  voxel::save(voxel::bake(scene, scene.lights.front(), options).shadow, file);
  Stage stage(device(), scene, scene.cameras.front(), scene.lights.front());
  EXPECT_NO_THROW(stage.look_up(*stage.make("cpvs,file=" + file)));
  EXPECT_THROW(stage.look_up(*stage.make("cpvs@512,file=" + file)), InputError);
  EXPECT_THROW(stage.look_up(*stage.make("cpvs,taps=17,file=" + file)), InputError);
  EXPECT_THROW(stage.look_up(*stage.make("cpvs,far=mraa,file=" + file)), InputError);
  const auto check_spec = [&](const std::string& spec, const Light& light) { check(parse_spec(spec), scene, light); };
  const Light& light = scene.lights.front();
  EXPECT_NO_THROW(check_spec("cpvs,file=" + file, light));
  for (const char* spec : {"cpvs@512,file=", "cpvs,taps=17,file=", "cpvs,far=mraa,file=", "cpvs,file=missing"})
    EXPECT_THROW(check_spec(spec + file, light), InputError) << spec;
  EXPECT_THROW(check_spec("cpvs,file=" + file, sun(200, 30)), InputError);
  const Stage other(device(), scene, scene.cameras.front(), sun(200, 30));
  try {
    other.look_up(*other.make("cpvs,file=" + file));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_LT(text.find("directional light along"), text.rfind("directional light along")) << text;
  }
  std::remove(file.c_str());
}

}  // namespace
}  // namespace shadewright::shadow
