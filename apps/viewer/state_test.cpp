#include "state.h"

#include <gtest/gtest.h>

#include "shadewright/scene/load.h"

namespace shadewright::viewer {
namespace {

TEST(ViewerState, KeepsTheLastTechniqueWhileTheTextIsNone) {
  SideChoice side;
  side.set("psm@512");
  EXPECT_EQ(side.problem, "");
  side.set("psm@512,warp=");
  EXPECT_NE(side.problem, "");
  EXPECT_EQ(side.text, "psm@512,warp=");
  EXPECT_EQ(side.spec->canonical(), "perspective/depth/hard@512");
}

TEST(ViewerState, TellsTheCommandThatReportsWhatIsShown) {
  Scene scene;
  scene.origin = {1000, 0, 0};
  Told told;
  told.scene = &scene;
  told.scene_source = "a town.glb";
  told.picture = vk::Extent2D(640, 360);
  State state;
  state.camera.eye = {-1, 2, 3.5};
  state.camera.target = {0, 0, 0};
  state.camera.fov_y = glm::radians(45.0);
  state.light = sun(-10, 30);
  state.sun = {-10, 30};
  state.sides[left].set("psm@512");
  state.sides[right].set("ray");
  EXPECT_EQ(compare_command(state, told),
            "shadewright compare 'a town.glb' --eye=999,2,3.5 --target=1000,0,0 --fov 45 --sun=-10,30 --size 640x360 "
            "-t 'psm@512' -o out/view");
  state.compares = true;
  state.light.kind = LightKind::point;
  state.light.name = "Bob's lamp";
  EXPECT_EQ(compare_command(state, told),
            "shadewright compare 'a town.glb' --eye=999,2,3.5 --target=1000,0,0 --fov 45 --light 'Bob'\\''s lamp' "
            "--size 640x360 "
            "-t 'psm@512' -t 'ray' -o out/view");
}

TEST(ViewerState, TimeRunsAsLongAsAPathOrTheMotions) {
  const Scene scene = load_scene("builtin:street").scene;
  EXPECT_EQ(duration(scene, "main"), find_path(scene, "main").times.back());
  EXPECT_GT(duration(scene, ""), 0);
  EXPECT_EQ(duration(Scene(), ""), 0);
}

}  // namespace
}  // namespace shadewright::viewer
