#include <numeric>
#include <random>
#include <vector>

#include "gpu/compaction.h"
#include "gpu/device_for_test.h"
#include "gpu/radix_sort.h"
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

TEST_F(GpuTest, RefusesDevicesWithoutTheExtensionsAskedFor) {
  DeviceOptions options;
  options.instance_extensions = {VK_KHR_SURFACE_EXTENSION_NAME};
  options.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  EXPECT_NO_THROW(Device{options});
  options.device_extensions.emplace_back("VK_NOBODY_has_this");
  try {
    Device{options};
    FAIL() << "accepted";
  } catch (const FailureError& error) {
    EXPECT_NE(std::string(error.what()).find("no VK_NOBODY_has_this"), std::string::npos) << error.what();
  }
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

TEST_F(GpuTest, ScansLikeTheStandardLibrary) {
  std::mt19937 random(5);
  const Scan scan(device(), 2'000'003);
  for (const uint32_t count : {0u, 1u, 7u, 63u, 64u, 1'023u, 1'024u, 1'025u, 65'537u, 70'001u, 2'000'003u}) {
    std::vector<uint32_t> values(count), expected(count);
    for (uint32_t& value : values) value = static_cast<uint32_t>(random() % 1000);
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0u);
    const Buffer buffer = make_buffer<uint32_t>(device(), "numbers", values);
    submit_and_wait(device(), [&](const auto& commands) { scan.record(commands, buffer, count); });
    const auto bytes = read_back(device(), buffer, std::max<uint64_t>(count * sizeof(uint32_t), 4));
    EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), count * sizeof(uint32_t)), 0) << count;
    const auto totals = read_back(device(), scan.totals(), scan.totals().size());
    uint32_t total;
    std::memcpy(&total, totals.data() + Scan::total_index(count) * sizeof(uint32_t), sizeof(total));
    EXPECT_EQ(total, std::accumulate(values.begin(), values.end(), 0u)) << count;
  }
}

std::vector<uint32_t> read_numbers(const Device& device, const Buffer& buffer, size_t count) {
  std::vector<uint32_t> numbers(count);
  const auto bytes = read_back(device, buffer, std::max<uint64_t>(count * sizeof(uint32_t), 4));
  std::memcpy(numbers.data(), bytes.data(), count * sizeof(uint32_t));
  return numbers;
}

TEST_F(GpuTest, CompactsLikeTheStandardLibrary) {
  std::mt19937 random(6);
  const Compaction compaction(device(), 2'000'003);
  for (const uint32_t count : {0u, 1u, 2u, 255u, 256u, 70'001u, 2'000'003u}) {
    std::vector<uint32_t> values(count), kept;
    for (uint32_t& value : values) value = random() % 3 == 0 ? ~0u : static_cast<uint32_t>(random() % 1000);
    std::copy_if(values.begin(), values.end(), std::back_inserter(kept), [](uint32_t v) { return v != ~0u; });
    const Buffer in = make_buffer<uint32_t>(device(), "numbers", values);
    const Buffer out(device(), "kept", std::max(count, 1u) * sizeof(uint32_t));
    submit_and_wait(device(), [&](const auto& commands) { compaction.record(commands, in, count, out); });
    const uint32_t at = Scan::total_index(count);
    EXPECT_EQ(read_numbers(device(), compaction.scan().totals(), at + 1)[at], kept.size()) << count;
    EXPECT_EQ(read_numbers(device(), out, kept.size()), kept) << count;
  }
}

TEST_F(GpuTest, SortsAndUniquifiesLikeTheStandardLibrary) {
  std::mt19937 random(7);
  const RadixSort sort(device(), 2'000'003);
  const Compaction compaction(device(), 2'000'003);
  for (const uint32_t bits : {12u, 23u, 32u})
    for (const uint32_t count : {0u, 1u, 2u, 1'023u, 1'025u, 70'001u, bits == 23 ? 2'000'003u : 3u}) {
      std::vector<uint32_t> keys(count);
      for (uint32_t& key : keys) key = static_cast<uint32_t>(random() & ((uint64_t{1} << bits) - 1));
      const Buffer buffer = make_buffer<uint32_t>(device(), "keys", keys);
      const Buffer unique(device(), "unique keys", std::max(count, 1u) * sizeof(uint32_t));
      submit_and_wait(device(), [&](const auto& commands) {
        sort.record(commands, buffer, count, bits);
        memory_barrier(commands);
        compaction.record_unique(commands, buffer, count, unique);
      });
      std::sort(keys.begin(), keys.end());
      EXPECT_EQ(read_numbers(device(), buffer, count), keys) << count << " of " << bits << " bits";
      keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
      EXPECT_EQ(read_numbers(device(), unique, keys.size()), keys) << count << " of " << bits << " bits";
    }
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
