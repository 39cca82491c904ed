#include "baker.h"

#include <gtest/gtest.h>

#include <thread>

#include "shadewright/error.h"
#include "shadewright/scene/load.h"

namespace shadewright::viewer {
namespace {

TEST(ViewerBaker, KeepsWhatItBakedAndBakesWhatIsAnother) {
  const Scene scene = load_scene("builtin:spheres").scene;
  Baker bake([](const std::string&, double) { return true; });
  voxel::BakeOptions options;
  options.resolution = 256;
  const void* first = bake(scene, sun(30, 40), options).dags()[0].nodes.data();
  EXPECT_EQ(bake(scene, sun(30, 40), options).dags()[0].nodes.data(), first);
  EXPECT_NE(bake(scene, sun(31, 40), options).dags()[0].nodes.data(), first);
  options.max_filter = 3;
  EXPECT_NE(bake(scene, sun(30, 40), options).dags()[0].nodes.data(), first);
}

TEST(ViewerBaker, WatchesFromTheCallersThreadAndGivesUp) {
  const Scene scene = load_scene("builtin:landscape").scene;
  voxel::BakeOptions options;
  options.resolution = 262144;
  const auto caller = std::this_thread::get_id();
  int looks = 0;
  Baker bake([&](const std::string&, double) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++looks < 3;
  });
  EXPECT_THROW(bake(scene, sun(30, 40), options), FailureError);
  EXPECT_GE(looks, 3);
  Baker closing([](const std::string&, double) -> bool { throw std::string("closed"); });
  EXPECT_THROW(closing(scene, sun(30, 40), options), std::string);
}

}  // namespace
}  // namespace shadewright::viewer
