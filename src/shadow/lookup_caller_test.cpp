// A caller's own shader that includes a look-up answers what the technique answers, for every combination there is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "gpu/device_for_test.h"
#include "render/shared.h"
#include "shaders/lookup_callers.h"
#include "shadewright/scene/builtin.h"
#include "shadow/parts.h"
#include "shadow/view_for_test.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 96, height = 64;

class LookupCallerTest : public gpu::DeviceTest {
 protected:
  LookupCallerTest() : scene_(make_builtin("sandbox")), view_(device(), scene_, scene_.cameras.front(), width, height) {
    view_.frame().light = scene_.lights.front();
  }

  std::unique_ptr<Technique> make(const std::string& spec) const {
    TechniqueOptions options{width, height};
    options.scene = &scene_;
    return make_technique(device(), parse_spec(spec), options);
  }

  /// The caller's shader answers what `technique` does, with the constants that it names or with none.
  void expect_same_answers(Technique& technique, bool specialized) {
    const auto expected = view_.look_up(technique);
    EXPECT_GT(std::ranges::count(expected, std::byte{0}), 100);
    EXPECT_GT(std::ranges::count(expected, std::byte{255}), 100);
    const auto shader = shader_for(technique);
    ASSERT_FALSE(shader.empty());
    std::array<uint32_t, 4> constants{};
    const auto named = technique.lookup_constants();
    ASSERT_LE(named.size(), constants.size());
    std::ranges::copy(named, constants.begin());
    const auto caller = specialized ? pass(shader, technique, {constants[0], constants[1], constants[2], constants[3]})
                                    : pass(shader, technique, {});
    EXPECT_EQ(count_others(expected, ask(caller, technique)), 0u) << (specialized ? "specialized" : "not specialized");
  }

  Light point_light() const {
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = scene_.cameras.front().target + glm::dvec3(0.3, 1.1, 0.2);
    return lamp;
  }

  const Scene& scene() const { return scene_; }
  Frame& frame() { return view_.frame(); }

 private:
  /// The shader that defines and includes what the technique says.
  static std::span<const uint32_t> shader_for(const Technique& technique) {
    std::string text;
    for (const std::string& define : technique.lookup_defines()) text += fmt::format("#define {}\n", define);
    for (const std::string& include : technique.lookup_includes()) text += fmt::format("#include \"{}\"\n", include);
    for (const auto& [key, words] : shaders::lookup_callers)
      if (key == text) return words;
    ADD_FAILURE() << "no shader begins with\n" << text;
    return {};
  }

  static gpu::ComputePass pass(std::span<const uint32_t> shader, const Technique& technique,
                               std::initializer_list<uint32_t> constants) {
    using enum gpu::BindingKind;
    const vk::DescriptorSetLayout layout = technique.lookup_layout();
    return {device(), shader, {uniform_buffer, sampled_image, sampled_image, storage_buffer}, 0, std::span(&layout, 1),
            constants};
  }

  /// What the shader answers for each pixel after `technique` was recorded.
  std::vector<float> ask(const gpu::ComputePass& pass, const Technique& technique) const {
    const Frame& frame = view_.frame();
    const gpu::Buffer camera(device(), "camera", sizeof(shared::CameraData), gpu::HostAccess::write);
    camera.mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
    std::vector<float> answers(size_t{width} * height);
    const uint64_t bytes = answers.size() * sizeof(float);
    const gpu::Buffer buffer(device(), "answers", bytes);
    const auto sampler = gpu::make_sampler(device(), vk::Filter::eNearest);
    const vk::DescriptorSet set = technique.lookup_set(frame);
    gpu::submit_and_wait(device(), [&](const vk::raii::CommandBuffer& commands) {
      using gpu::Binding;
      const Binding bindings[] = {Binding::uniform(camera), Binding::sampled(frame.depth, *sampler),
                                  Binding::sampled(frame.normal, *sampler), Binding::storage(buffer)};
      pass.dispatch(commands, bindings, {}, {gpu::groups(width, 8), gpu::groups(height, 8), 1}, std::span(&set, 1));
    });
    std::memcpy(answers.data(), gpu::read_back(device(), buffer, bytes).data(), bytes);
    return answers;
  }

  /// How many pixels differ by more than the rounding to 8 bits.
  static size_t count_others(std::span<const std::byte> expected, std::span<const float> answers) {
    size_t count = 0;
    for (size_t i = 0; i < expected.size(); ++i)
      count += std::abs(255.0f * answers[i] - static_cast<float>(expected[i])) > 0.51f;
    return count;
  }

  Scene scene_;
  ViewForTest view_;
};

std::vector<std::string> combinations() {
  const auto of = [](std::string_view axis) {
    std::vector<std::string> names;
    for (const Part& part : parts())
      if (part.axis == axis) names.emplace_back(part.name);
    return names;
  };
  std::vector<std::string> built;
  for (const auto& parameterization : of("parameterization"))
    for (const auto& storage : of("storage"))
      for (const auto& filter : of("filter"))
        if (is_built(parameterization, storage, filter))
          built.push_back(parameterization + "/" + storage + "/" + filter);
  return built;
}

class MapLookupCallerTest : public LookupCallerTest, public testing::WithParamInterface<std::string> {};

TEST_P(MapLookupCallerTest, GetsTheAnswersOfTheTechnique) {
  const std::string parameterization = parse_spec(GetParam()).parameterization;
  expect_same_answers(*make(fmt::format("{}@{}", GetParam(), 4 * resolutions(parameterization).min)), false);
}

INSTANTIATE_TEST_SUITE_P(Maps, MapLookupCallerTest, testing::ValuesIn(combinations()), [](const auto& info) {
  std::string name = info.param;
  std::ranges::replace(name, '/', '_');
  return name;
});

TEST_F(LookupCallerTest, NeedNotTellThatALightHasSixFaces) {
  for (const char* spec : {"sm@256", "spsm@256", "paged@4096"}) {
    SCOPED_TRACE(spec);
    const auto technique = make(spec);
    for (const Light& light : {point_light(), scene().lights.front()}) {
      frame().light = light;
      for (const bool specialized : {true, false}) expect_same_answers(*technique, specialized);
    }
  }
}

TEST_F(LookupCallerTest, GetsTheAnswersOfPrecomputedShadows) {
  for (const char* access : {"windows", "image", "address"})
    for (const char* precision : {"float", "double"}) {
      const bool filtered = precision == std::string_view("double");
      const std::string spec =
          fmt::format("cpvs@512,access={},precision={},taps={}", access, precision, filtered ? 5 : 1);
      SCOPED_TRACE(spec);
      expect_same_answers(*make(spec), filtered);
    }
}

}  // namespace
}  // namespace shadewright::shadow
