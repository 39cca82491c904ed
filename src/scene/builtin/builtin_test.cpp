// Every built-in scene: builds, is sound, has what it states, and gives the same bytes each time.
#include "shadewright/scene/builtin.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "scene/builtin/mesh_check.h"
#include "shadewright/error.h"

namespace shadewright {
namespace {

struct Expected {
  std::string query;
  size_t triangles;  ///< with every instance counted; within 5 %
  bool closed;       ///< every mesh is a closed oriented 2-manifold
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.query;
}

const Expected expectations[] = {
    {"characters", 61000, true},
    {"characters?skeletons=1", 80000, true},
    {"chess", 30000, true},
    {"city", 58000, true},
    {"city?triangles=613000", 613000, true},
    {"ecosystem", 22000000, false},
    {"furball", 298500, true},  // 4,000 hairs of 12 x 6 + 2 triangles, ball, plinth, wall
    {"landscape?triangles=200000", 200000, true},
    {"lattice", 155000, true},
    {"playground", 712000, true},
    {"ruins?triangles=373000", 373000, false},
    {"sandbox", 28000, true},
    {"spheres", 12000, true},
    {"street", 100000, true},
    {"street?crowd=1", 327000, true},
    {"town", 528000, true},
    {"trees", 48000, false},
};

bool same_bytes(const Scene& a, const Scene& b) {
  if (a.meshes.size() != b.meshes.size() || a.instances.size() != b.instances.size()) return false;
  for (size_t i = 0; i < a.meshes.size(); ++i)
    if (a.meshes[i].positions != b.meshes[i].positions || a.meshes[i].triangles != b.meshes[i].triangles) return false;
  for (size_t i = 0; i < a.instances.size(); ++i) {
    const Instance &p = a.instances[i], &q = b.instances[i];
    if (p.name != q.name || p.mesh != q.mesh || p.world_from_mesh != q.world_from_mesh || p.albedo != q.albedo ||
        p.motion != q.motion)
      return false;
  }
  return true;
}

class Builtin : public testing::TestWithParam<Expected> {};

TEST_P(Builtin, IsWhatItSays) {
  const Scene scene = make_builtin(GetParam().query);
  const double stated = static_cast<double>(GetParam().triangles);
  EXPECT_NEAR(static_cast<double>(triangle_count(scene)), stated, 0.05 * stated);
  EXPECT_EQ(scene.name, GetParam().query.substr(0, GetParam().query.find('?')));
  for (const Mesh& mesh : scene.meshes) {
    SCOPED_TRACE(mesh.name);
    EXPECT_FALSE(mesh.name.empty());
    EXPECT_EQ(builtin::count_unsound_triangles(mesh), 0u);
    if (!GetParam().closed) continue;
    EXPECT_EQ(builtin::count_open_edges(mesh), 0u);
    EXPECT_GT(builtin::signed_volume(mesh), 0);
  }
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size());
    if (instance.motion) {
      ASSERT_LT(*instance.motion, scene.motions.size());
    }
    // Mirrored instances would turn their triangles' outside inside.
    EXPECT_GT(glm::determinant(glm::dmat3(instance.world_from_mesh)), 0) << instance.name;
    EXPECT_EQ(glm::clamp(instance.albedo, 0.0f, 1.0f), instance.albedo) << instance.name;
  }
  EXPECT_TRUE(same_bytes(scene, make_builtin(GetParam().query)));
}

TEST_P(Builtin, HasCamerasLightsAndSoundMotions) {
  const Scene scene = make_builtin(GetParam().query);
  ASSERT_FALSE(scene.cameras.empty());
  ASSERT_FALSE(scene.lights.empty());
  std::set<std::string> names;
  for (const Camera& camera : scene.cameras) EXPECT_TRUE(names.insert(camera.name).second) << camera.name;
  for (const Light& light : scene.lights) {
    EXPECT_FALSE(light.name.empty());
    EXPECT_NEAR(glm::length(light.direction), 1, 1e-9);
    EXPECT_EQ(light.name == "sun", light.kind == LightKind::directional);
  }
  for (const Motion& motion : scene.motions) {
    ASSERT_EQ(motion.times.size(), motion.translations.size());
    ASSERT_EQ(motion.times.size(), motion.rotations.size());
    for (size_t i = 1; i < motion.times.size(); ++i) EXPECT_LT(motion.times[i - 1], motion.times[i]);
    for (const glm::dquat& q : motion.rotations) EXPECT_NEAR(glm::length(q), 1, 1e-9);
  }
  for (const CameraPath& path : scene.paths) {
    EXPECT_FALSE(path.name.empty());
    ASSERT_EQ(path.times.size(), path.keys.size());
    for (size_t i = 1; i < path.times.size(); ++i) EXPECT_LT(path.times[i - 1], path.times[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Builtin, testing::ValuesIn(expectations), [](const auto& info) {
  std::string name;
  for (const char c : info.param.query) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(BuiltinRegistry, ListsEveryScene) {
  std::set<std::string> tested, listed;
  for (const Expected& expected : expectations) tested.insert(expected.query.substr(0, expected.query.find('?')));
  for (const BuiltinScene& scene : builtin_scenes()) {
    EXPECT_TRUE(listed.insert(scene.name).second) << scene.name;
    EXPECT_FALSE(scene.help.empty());
    for (const BuiltinParameter& p : scene.parameters) {
      EXPECT_LE(p.min, p.default_value);
      EXPECT_LE(p.default_value, p.max);
    }
  }
  EXPECT_EQ(tested, listed);
}

/// The sentence that a wrong name or query is answered with.
std::string complaint(std::string_view query) {
  try {
    make_builtin(query);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BuiltinQuery, SaysWhatIsWrongAndWhatThereIs) {
  EXPECT_NE(complaint("ches").find("chess, city"), std::string::npos) << complaint("ches");
  EXPECT_NE(complaint("").find("chess, city"), std::string::npos);
  EXPECT_NE(complaint("city?size=3").find("triangles=20000 .. 2500000"), std::string::npos) << complaint("city?size=3");
  EXPECT_NE(complaint("chess?size=3").find("no parameters"), std::string::npos) << complaint("chess?size=3");
  EXPECT_NE(complaint("city?triangles=1").find("out of range"), std::string::npos) << complaint("city?triangles=1");
  for (const char* query : {"city?triangles", "city?triangles=", "city?triangles=many", "city?triangles=58000x",
                            "city?triangles=nan", "city?triangles=inf", "city?triangles=3e9",
                            "city?triangles=58000&triangles=58000", "city?triangles=58000&&", "city?=1"})
    EXPECT_NE(complaint(query), "") << query;
}

TEST(BuiltinQuery, AcceptsAnEmptyQuery) {
  EXPECT_EQ(make_builtin("spheres?").name, "spheres");
}

}  // namespace
}  // namespace shadewright
