#include "scene/load_file.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/scene_files_for_test.h"

namespace shadewright {
namespace {

using nlohmann::json;

/// The scene of this JSON over one triangle's bytes.
LoadedScene load_json(const json& gltf, const std::string& binary = triangle_bytes()) {
  const TemporaryFolder folder;
  return load_file(folder.write("scene.glb", make_glb(gltf.dump(), binary)));
}

std::string error_of(const json& gltf, const std::string& binary = triangle_bytes()) {
  return input_error([&] { load_json(gltf, binary); });
}

TEST(LoadFile, RefusesWhatIsNoScene) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& path) { return input_error([&] { load_file(path); }); };
  EXPECT_EQ(error(folder.file("no.glb")), folder.file("no.glb") +
                                              ": there is no such file; check the path, or give builtin:NAME for a "
                                              "built-in scene");
  EXPECT_NE(error(folder.path().string()).find("is a directory"), std::string::npos);
  EXPECT_NE(error(folder.write("empty.glb", "")).find("is empty"), std::string::npos);
  for (const char* name : {"text.glb", "text.gltf", "text.obj", "text.ply", "text.txt", "text.blend", "text"})
    EXPECT_NE(error(folder.write(name, "no scene at all\n")).find(name), std::string::npos);
  EXPECT_NE(error(folder.write("old.glb", "glTF" + word(1) + word(20) + word(0) + word(0))).find("convert"),
            std::string::npos);
  EXPECT_NE(error(folder.write("bare.gltf", R"({"asset": {"version": "2.0"}})")).find("no triangles"),
            std::string::npos);
}

TEST(LoadFile, TakesWhatTheFileDoesNotTellFromItsName) {
  const TemporaryFolder folder;
  json gltf = triangle_gltf();
  gltf["nodes"].push_back({{"name", "SkyBox"}, {"mesh", 0}, {"translation", {9, 9, 9}}});
  gltf["scenes"][0]["nodes"] = {0, 1};
  const std::string file = folder.write("z.glb", make_glb(gltf.dump(), triangle_bytes()));
  EXPECT_EQ(load_file(file).scene.instances.size(), 2u);
  const Scene turned = load_file(file + "?up=z&without=Sky*").scene;
  ASSERT_EQ(turned.instances.size(), 1u);
  // The triangle lies at (0,0,0), (1,0,0), (0,0,1): its third corner, up along Z in the file, is now up along Y.
  const Box box = bounds(turned);
  EXPECT_NEAR(box.max.y, 1, 1e-6);
  EXPECT_NEAR(box.size().z, 0, 1e-6);
  EXPECT_NE(input_error([&] { load_file(file + "?without=Moon"); }).find("no node has that name"), std::string::npos);
  EXPECT_NE(input_error([&] { load_file(file + "?up=x"); }).find("up=z"), std::string::npos);
}

TEST(LoadFile, RefusesEveryTruncation) {
  const TemporaryFolder folder;
  const std::string whole = make_glb(triangle_gltf().dump(), triangle_bytes());
  EXPECT_EQ(triangle_count(load_file(folder.write("whole.glb", whole)).scene), 1u);
  for (size_t size = 1; size < whole.size(); size += 7)
    input_error([&] { load_file(folder.write("cut.glb", whole.substr(0, size))); });
}

TEST(LoadFile, RefusesRangesThatLie) {
  EXPECT_NE(error_of(triangle_gltf(), triangle_bytes({}, {0, 1, 3})).find("index out of range"), std::string::npos);
  const auto with = [](const char* pointer, const json& value) {
    json gltf = triangle_gltf();
    gltf[json::json_pointer(pointer)] = value;
    return gltf;
  };
  EXPECT_NE(error_of(with("/accessors/0/count", 4)).find("accessor 0 reaches past"), std::string::npos);
  EXPECT_NE(error_of(with("/accessors/0/byteOffset", 4)).find("accessor 0 reaches past"), std::string::npos);
  EXPECT_NE(error_of(with("/bufferViews/1/byteOffset", 40)).find("buffer view (1)"), std::string::npos);
  EXPECT_NE(error_of(with("/buffers/0/byteLength", 4000)).find("truncated"), std::string::npos);
  for (const json& bad : {json(-1), json(1e18), json(18446744073709551615u), json("x"), json(), json(0.5)})
    for (const char* member : {"/accessors/0/count", "/accessors/1/bufferView", "/bufferViews/0/byteLength",
                               "/bufferViews/0/byteStride", "/nodes/0/mesh", "/scenes/0/nodes/0", "/scene",
                               "/meshes/0/primitives/0/indices", "/meshes/0/primitives/0/mode"})
      EXPECT_FALSE(error_of(with(member, bad)).empty()) << member << " = " << bad;
  EXPECT_NE(error_of(with("/nodes/0/children", {0})).find("no tree"), std::string::npos);
  EXPECT_NE(error_of(with("/extensionsRequired", {"KHR_draco_mesh_compression"})).find("KHR_draco"), std::string::npos);
}

TEST(LoadFile, NeverCrashesOnDamage) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  write_glb(full_scene(), folder.file("whole.glb"));
  const std::string whole = read_text(folder.file("whole.glb"));
  int loaded = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string damaged = whole;
    const size_t flips = 1 + random() % 4;
    for (size_t k = 0; k < flips; ++k) {
      char& byte = damaged[random() % damaged.size()];
      // Digits become other digits half of the time: damage that still parses.
      const bool is_digit = byte >= '0' && byte <= '9';
      byte = is_digit && random() % 2 ? static_cast<char>('0' + random() % 10) : static_cast<char>(random());
    }
    if (random() % 8 == 0) damaged.resize(random() % damaged.size() + 1);
    try {
      load_file(folder.write("damaged.glb", damaged));
      ++loaded;
    } catch (const InputError&) {
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "damage " << i << ": " << error.what();
    }
  }
  EXPECT_GT(loaded, 0);
  EXPECT_GT(refused, 0);
}

TEST(LoadFile, ReadsGltfWithItsBuffers) {
  const TemporaryFolder folder;
  json gltf = triangle_gltf();
  gltf["buffers"][0]["uri"] = "my%20data.bin";
  const std::string path = folder.write("scene.gltf", gltf.dump());
  EXPECT_NE(input_error([&] { load_file(path); }).find("needs the file"), std::string::npos);
  folder.write("my data.bin", triangle_bytes());
  EXPECT_EQ(load_file(path).scene.name, "scene");

  // The 42 bytes of the triangle (0,0,0) (1,0,0) (0,0,1), indices 0 1 2.
  gltf["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAAIA";
  const Scene scene = load_file(folder.write("inline.gltf", gltf.dump())).scene;
  EXPECT_EQ(bounds(scene).max, glm::dvec3(1, 0, 1));
}

TEST(LoadFile, TellsWhatItLeftOutOnceEach) {
  json gltf = triangle_gltf();
  json& primitives = gltf["meshes"][0]["primitives"];
  gltf["materials"] = {{{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}}},
                       {{"alphaMode", "BLEND"}}};
  primitives[0]["material"] = 0;
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 1;
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  primitives.push_back({{"attributes", {{"POSITION", 2}}}});
  gltf["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  gltf["accessors"][2]["bufferView"] = 2;
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 36}});
  gltf["buffers"][0]["byteLength"] = 80;
  std::string binary = triangle_bytes();
  binary.resize(80, '\0');
  const LoadedScene loaded = load_json(gltf, binary);
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{"1 sets of points or lines were left out.",
                                                       "Materials with alpha (masked or blended) are drawn opaque.",
                                                       "1 triangles without an area were left out."}));
  EXPECT_EQ(loaded.scene.meshes.size(), 1u) << "the same accessors are the same mesh";
  ASSERT_EQ(loaded.scene.instances.size(), 2u);
  EXPECT_EQ(loaded.scene.instances[0].albedo, glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(loaded.scene.instances[1].albedo, glm::vec3(1.0f));
}

TEST(LoadFile, RefusesScenesOfOnlyBrokenTriangles) {
  EXPECT_NE(error_of(triangle_gltf(), triangle_bytes({NAN, 0, 0, 1, 0, 0, 0, 0, 1})).find("no triangles"),
            std::string::npos);
}

TEST(LoadFile, ComposesNodesInDoubleFarAway) {
  json gltf = triangle_gltf();
  gltf["nodes"] = {{{"translation", {1e6, 0, 0}}, {"children", {1}}},
                   {{"mesh", 0}, {"translation", {0.0625, 0, 1e6 + 0.001}}, {"scale", {2, 2, 2}}}};
  const Scene scene = load_json(gltf).scene;
  const Box box = bounds(scene);
  EXPECT_LT(glm::length(box.center()), 100.0);
  expect_near(scene.origin + box.min, {1000000.0625, 0, 1000000.001}, 1e-9);
  expect_near(scene.origin + box.max, {1000002.0625, 0, 1000002.001}, 1e-9);
}

TEST(LoadFile, MovesFarVerticesToZero) {
  const Scene scene =
      load_json(triangle_gltf(), triangle_bytes({1e6f, 0, 1e6f, 1e6f + 1, 0, 1e6f, 1e6f, 0, 1e6f + 1})).scene;
  EXPECT_LT(glm::length(bounds(scene.meshes[0]).center()), 10.0);
  EXPECT_EQ(scene.origin + bounds(scene).min, glm::dvec3(1e6, 0, 1e6));
  EXPECT_EQ(scene.origin + bounds(scene).max, glm::dvec3(1e6 + 1, 0, 1e6 + 1));
}

TEST(LoadFile, ReadsVerySmallAndVeryLargeScenes) {
  for (const float size : {1e-12f, 1e15f}) {
    const Scene scene = load_json(triangle_gltf(), triangle_bytes({0, 0, 0, size, 0, 0, 0, 0, size})).scene;
    EXPECT_EQ(bounds(scene).max.x, static_cast<double>(size));
  }
}

/// A triangle under two nodes that both turn about Y by `turns` quarter turns within a second.
json turning_gltf(bool both) {
  json gltf = triangle_gltf();
  gltf["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  gltf["buffers"][0]["byteLength"] = 84;
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 8}});
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 52}, {"byteLength", 32}});
  gltf["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  gltf["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 2}, {"type", "VEC4"}});
  json& animation = gltf["animations"][0];
  animation["samplers"] = {{{"input", 2}, {"output", 3}}};
  animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}};
  if (both) animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}});
  return gltf;
}

std::string turning_bytes() {
  const float half = std::sqrt(0.5f);
  const float keys[10] = {0, 1, /* */ 0, 0, 0, 1, /* */ 0, half, 0, half};
  std::string binary = triangle_bytes();
  binary.resize(44, '\0');
  return binary + std::string(reinterpret_cast<const char*>(keys), sizeof keys);
}

TEST(LoadFile, ReadsMotions) {
  const Scene scene = load_json(turning_gltf(false), turning_bytes()).scene;
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_EQ(scene.motions[0].times, (std::vector<double>{0, 1})) << "one animated node needs no keys of ours";
  const glm::dmat4 half_way = transform_at(scene, scene.instances[0], 0.5);
  expect_near(glm::dvec3(half_way[3]), {5 * std::sqrt(0.5), 0, -5 * std::sqrt(0.5)}, 1e-6);
}

TEST(LoadFile, BakesChainsOfAnimatedNodes) {
  const Scene scene = load_json(turning_gltf(true), turning_bytes()).scene;
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_GE(scene.motions[0].times.size(), 31u);
  // Inner and outer turn add up: by 90 degrees at half time, around a centre that has gone 45.
  const glm::dmat4 half_way = transform_at(scene, scene.instances[0], 0.5);
  expect_near(glm::dvec3(half_way[3]), {5 * std::sqrt(0.5), 0, -5 * std::sqrt(0.5)}, 1e-3);
  expect_near(glm::dvec3(half_way[0]), {0, 0, -1}, 1e-6);
}

TEST(LoadFile, PlaysOneAnimationOfANode) {
  // A second clip turns another node, which is played too, and slides the first node, which is not.
  json gltf = turning_gltf(false);
  gltf["animations"].push_back(gltf["animations"][0]);
  gltf["animations"][1]["channels"][0]["target"]["node"] = 1;
  EXPECT_TRUE(load_json(gltf, turning_bytes()).warnings.empty());
  gltf["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  gltf["animations"][1]["samplers"][0]["output"] = 4;
  gltf["animations"][1]["channels"][0]["target"] = {{"node", 0}, {"path", "translation"}};
  const LoadedScene loaded = load_json(gltf, turning_bytes());
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"Only the first animation of each node is played."});
  const Scene alone = load_json(turning_gltf(false), turning_bytes()).scene;
  ASSERT_EQ(loaded.scene.motions.size(), 1u);
  EXPECT_EQ(loaded.scene.motions[0].translations, alone.motions[0].translations);
}

TEST(LoadFile, MovesAllThatHangsBelowAMoverByOneMotion) {
  json gltf = turning_gltf(false);
  gltf["nodes"] = {{{"children", {1, 2}}, {"mesh", 0}},
                   {{"mesh", 0}, {"translation", {5, 0, 0}}, {"children", {3}}},
                   {{"mesh", 0}, {"translation", {0, 0, 2}}},
                   {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  const Scene scene = load_json(gltf, turning_bytes()).scene;
  ASSERT_EQ(scene.motions.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 4u);
  // A quarter turn takes +X to -Z and +Z to +X.
  const glm::dvec3 at_the_end[] = {{0, 0, 0}, {0, 0, -5}, {0, 0, -6}, {2, 0, 0}};
  for (size_t i = 0; i < 4; ++i)
    expect_near(glm::dvec3(transform_at(scene, scene.instances[i], 1)[3]), at_the_end[i], 1e-6);
}

TEST(LoadFile, ReadsSparseAccessors) {
  // Two bytes of a sparse index, then of its value: the second corner's index becomes 0 and back again to 1.
  std::string binary = triangle_bytes({0, 0, 0, 1, 0, 0, 0, 0, 1}, {0, 0, 2});
  binary.resize(44, '\0');
  binary += std::string("\1\0\1\0", 4);
  json gltf = triangle_gltf();
  gltf["buffers"][0]["byteLength"] = 48;
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 2}});
  gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 46}, {"byteLength", 2}});
  EXPECT_NE(error_of(gltf, binary).find("no triangles"), std::string::npos) << "a corner twice";
  gltf["accessors"][1]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 2}, {"componentType", 5123}}}, {"values", {{"bufferView", 3}}}};
  EXPECT_EQ(triangle_count(load_json(gltf, binary).scene), 1u);
  // Without a buffer view the elements that are not replaced are zeros.
  gltf["accessors"][1].erase("bufferView");
  EXPECT_NE(error_of(gltf, binary).find("no triangles"), std::string::npos) << "0, 1, 0";
  gltf["accessors"][1]["count"] = 1'000'000'000;
  EXPECT_NE(error_of(gltf, binary).find("more elements"), std::string::npos);
}

TEST(LoadFile, NamesTheExtensionThatItDoesNotRead) {
  json gltf = triangle_gltf();
  gltf["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  EXPECT_EQ(load_json(gltf).warnings.size(), 1u);
  // As gltfpack writes them: a buffer without bytes stands for the uncompressed data.
  gltf["extensionsRequired"] = {"EXT_meshopt_compression"};
  gltf["buffers"].push_back({{"byteLength", 42}});
  EXPECT_NE(error_of(gltf).find("EXT_meshopt_compression"), std::string::npos);
}

TEST(LoadFile, RefusesScenesBeyondWhatRaysReach) {
  EXPECT_NE(error_of(triangle_gltf(), triangle_bytes({0, 0, 0, 5e18f, 0, 0, 0, 0, 5e18f})).find("metres from zero"),
            std::string::npos);
}

TEST(LoadFile, WarnsOfAnimatedScale) {
  json gltf = turning_gltf(false);
  gltf["animations"][0]["channels"][0]["target"]["path"] = "scale";
  gltf["accessors"][3] = {{"bufferView", 3}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}};
  const float keys[8] = {0, 1, 1, 1, 1, 2, 2, 2};
  std::string binary = triangle_bytes();
  binary.resize(44, '\0');
  binary += std::string(reinterpret_cast<const char*>(keys), sizeof keys);
  binary.resize(84, '\0');
  const LoadedScene loaded = load_json(gltf, binary);
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"An animation scales or shears; only its rigid part is played."});
}

TEST(LoadFile, ReadsObjWithoutATrace) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("square.obj", "o square\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\nf 1 2 2\n");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  int calls = 0;
  double last = 0;
  const LoadedScene loaded = load_file(path, [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, 0.0);
    last = fraction;
    ++calls;
  });
  input_error([&] { load_file(folder.write("bad.obj", "v 0 0\nf 1 9 7\n")); });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(triangle_count(loaded.scene), 2u);
  EXPECT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(last, 1.0);
  EXPECT_GT(calls, 1);
}

TEST(LoadFile, CanBeCancelledByItsProgress) {
  struct Cancelled {};
  const TemporaryFolder folder;
  const auto cancel = [](std::string_view, double) { throw Cancelled(); };
  EXPECT_THROW(load_file(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n"), cancel), Cancelled);
  EXPECT_THROW(load_file(folder.write("a.glb", make_glb(triangle_gltf().dump(), triangle_bytes())), cancel), Cancelled);
}

}  // namespace
}  // namespace shadewright
