#include <numeric>
#include <vector>

#include "gpu/device_for_test.h"
#include "shadewright/error.h"
#include "shadewright/gpu/pass.h"
#include "shadewright/gpu/recorder.h"
#include "shadewright/gpu/resources.h"

namespace shadewright::gpu {
namespace {

class GpuTest : public DeviceTest {};

TEST_F(GpuTest, ListsTheDeviceThatItPicks) {
  const auto all = Device::list();
  ASSERT_LT(device().info().index, all.size());
  EXPECT_EQ(all[device().info().index].name, device().info().name);
  EXPECT_TRUE(all[device().info().index].unusable.empty());
}

TEST_F(GpuTest, SelectsByIndexAndByPartOfTheName) {
  EXPECT_EQ(Device({std::to_string(device().info().index), false}).info().name, device().info().name);
  std::string part = device().info().name.substr(0, 4);
  for (char& c : part) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(Device({part, false}).info().name, device().info().name);
  EXPECT_THROW(Device({"no such device", false}), InputError);
  EXPECT_THROW(Device({"999", false}), InputError);
}

TEST_F(GpuTest, BuffersKeepWhatIsUploaded) {
  std::vector<uint32_t> values(100'003);
  std::iota(values.begin(), values.end(), 7u);
  const Buffer buffer = make_buffer<uint32_t>(device(), "numbers", values);
  EXPECT_EQ(buffer.allocation().name, "numbers");
  EXPECT_GE(buffer.size(), values.size() * 4);
  const auto bytes = read_back(device(), buffer, values.size() * 4);
  EXPECT_EQ(std::memcmp(bytes.data(), values.data(), bytes.size()), 0);
}

TEST_F(GpuTest, ImagesReadBackLayerByLayer) {
  Image image(device(), {"layers", vk::Format::eR8Unorm, 5, 3, 2,
                         vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc});
  submit_and_wait(device(), [&](const auto& commands) {
    image.transition(commands, vk::ImageLayout::eTransferDstOptimal, true);
    for (uint32_t layer = 0; layer < 2; ++layer)
      commands.clearColorImage(image.handle(), vk::ImageLayout::eTransferDstOptimal,
                               vk::ClearColorValue(static_cast<float>(layer), 0.0f, 0.0f, 0.0f),
                               vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, layer, 1));
  });
  EXPECT_EQ(read_back(device(), image, 1, 0), std::vector<std::byte>(15, std::byte{0}));
  EXPECT_EQ(read_back(device(), image, 1, 1), std::vector<std::byte>(15, std::byte{255}));
}

TEST_F(GpuTest, RefusesImagesBeyondTheDevice) {
  EXPECT_THROW(Image(device(), {"huge", vk::Format::eR8Unorm, 1u << 20, 1, 1, vk::ImageUsageFlagBits::eSampled}),
               InputError);
}

TEST_F(GpuTest, TellsStagesInOrder) {
  Recorder recorder(device());
  const Buffer buffer(device(), "target", 64);
  int on_cpu = 0;
  recorder.stage("fill", [&](const auto& commands) { commands.fillBuffer(buffer.handle(), 0, 64, 0x01010101u); });
  recorder.cpu_stage("count", [&] { ++on_cpu; });
  recorder.wait();
  EXPECT_EQ(read_back(device(), buffer, 64), std::vector<std::byte>(64, std::byte{1}));
  recorder.stage("fill again", [&](const auto& commands) { commands.fillBuffer(buffer.handle(), 0, 64, 0); });
  const auto stages = recorder.finish();
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[0].name, "fill");
  EXPECT_EQ(stages[1].name, "count");
  EXPECT_EQ(stages[2].name, "fill again");
  EXPECT_EQ(on_cpu, 1);
}

TEST_F(GpuTest, RefusesToWaitInACallersCommandBuffer) {
  submit_and_wait(device(), [&](const auto& commands) {
    Recorder recorder(device(), *commands);
    EXPECT_TRUE(recorder.embedded());
    EXPECT_THROW(recorder.wait(), std::logic_error);
  });
}

}  // namespace
}  // namespace shadewright::gpu
