#include "shadewright/compare/metrics.h"

#include <gtest/gtest.h>

#include <random>

#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

/// A floor at y = 0 seen as an image, one metre a pixel, under a sun at the zenith. Images are drawn in text:
/// '.' lit, '#' dark, ' ' not compared, '+' partly lit (0.75).
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<SurfacePoint> points;
  std::vector<uint8_t> facing, reference, oracle;
  std::vector<float> visibility, reference_filtered;
  std::vector<glm::vec3> texel_u, texel_v;

  Picture(const std::vector<std::string>& truth, const std::vector<std::string>& answer) {
    height = static_cast<uint32_t>(truth.size());
    width = height == 0 ? 0 : static_cast<uint32_t>(truth[0].size());
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        points.push_back({{static_cast<float>(x), 0, static_cast<float>(y)}, {0, 1, 0}});
        facing.push_back(truth[y][x] != ' ');
        reference.push_back(truth[y][x] == '.');
        visibility.push_back(answer[y][x] == '.' ? 1.0f : answer[y][x] == '+' ? 0.75f : 0.0f);
      }
  }

  void set_texel(float half_extent) {
    texel_u.assign(points.size(), {half_extent, 0, 0});
    texel_v.assign(points.size(), {0, 0, half_extent});
  }

  MetricsInput input() const {
    MetricsInput input;
    input.width = width;
    input.height = height;
    input.points = points;
    input.eye = {0, 10, 0};
    input.facing = facing;
    input.visibility = visibility;
    input.reference = reference;
    input.reference_filtered = reference_filtered;
    input.oracle = oracle;
    input.texel_u = texel_u;
    input.texel_v = texel_v;
    return input;
  }
};

/// A square sheet in the air, from (x0, z0) to (x1, z1).
Scene sheet(float x0, float z0, float x1, float z1) {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{x0, 1, z0}, {x1, 1, z0}, {x1, 1, z1}, {x0, 1, z1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {mesh};
  scene.instances.resize(1);
  return scene;
}

Light zenith() {
  Light light;
  light.direction = {0, -1, 0};
  return light;
}

/// A caster far from every picture: for the figures that need no truth beyond the image.
ErrorFigures measure(const Picture& picture) {
  const Tracer tracer(sheet(1000, 1000, 1001, 1001));
  return measure_error(picture.input(), tracer, zenith());
}

std::vector<std::string> uniform(size_t width, size_t height, char c) {
  return std::vector<std::string>(height, std::string(width, c));
}

TEST(Metrics, AllRightIsNoError) {
  const ErrorFigures e = measure({{"..#", "..#"}, {"..#", "..#"}});
  EXPECT_EQ(e.wrong, 0u);
  EXPECT_EQ(e.compared, 6u);
  EXPECT_EQ(e.image_pixels, 6u);
  EXPECT_EQ(e.fraction, 0);
  EXPECT_EQ(e.match, 1);
  EXPECT_EQ(e.boundary_fraction, 0);
  EXPECT_EQ(e.mean_absolute, 0);
  EXPECT_FALSE(e.oracle_fraction);
  EXPECT_FALSE(e.flicker);
}

TEST(Metrics, WrongIsSplitByItsSign) {
  const ErrorFigures e = measure({{"...##", "  .##"}, {"..#.#", ".##.#"}});
  EXPECT_EQ(e.false_shadow, 2u);
  EXPECT_EQ(e.false_lit, 2u);
  EXPECT_EQ(e.wrong, 4u);
  EXPECT_EQ(e.compared, 8u);
  EXPECT_EQ(e.image_pixels, 10u);
  EXPECT_DOUBLE_EQ(e.fraction, 0.5);
  EXPECT_DOUBLE_EQ(e.match, 0.6);
}

TEST(Metrics, HalfVisibleCountsAsLit) {
  Picture picture({"...."}, {"...."});
  picture.visibility = {0.5f, 0.499f, 1.0f, 0.0f};
  EXPECT_EQ(measure(picture).false_shadow, 2u);
}

TEST(Metrics, EdgePixelsHaveAComparedNeighbourOfOtherTruth) {
  EXPECT_EQ(measure({{"..##"}, {"..##"}}).edge_pixels, 2u);
  EXPECT_EQ(measure({{".. ##"}, {".. ##"}}).edge_pixels, 0u);  // no edge across what is not compared
  EXPECT_EQ(measure({{"...", ".#.", "..."}, {"...", "...", "..."}}).edge_pixels, 5u);  // no diagonal neighbours
  EXPECT_EQ(measure({{"....", "...."}, {"....", "...."}}).edge_pixels, 0u);
  EXPECT_EQ(measure({{".", "#"}, {".", "#"}}).edge_pixels, 2u);
}

TEST(Metrics, BoundaryIsADiscOfThreePixels) {
  // One dark pixel in the middle of a field, its neighbours are edge pixels too; everything is answered wrongly as
  // dark.
  const size_t n = 15, middle = 7;
  std::vector<std::string> truth = uniform(n, n, '.');
  truth[middle][middle] = '#';
  const std::vector<std::string> dark = uniform(n, n, '#');
  uint64_t near = 0;
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 15; ++x) {
      bool close = false;
      for (const auto& [ex, ey] : {std::pair{7, 7}, {6, 7}, {8, 7}, {7, 6}, {7, 8}})
        close = close || (x - ex) * (x - ex) + (y - ey) * (y - ey) <= 9;
      near += close;
    }
  const ErrorFigures e = measure({truth, dark});
  EXPECT_EQ(e.edge_pixels, 5u);
  EXPECT_DOUBLE_EQ(e.boundary_fraction, static_cast<double>(near - 1) / static_cast<double>(near));
  EXPECT_EQ(e.wrong, n * n - 1);
  EXPECT_EQ(e.interior_false_shadow, n * n - near);
  EXPECT_EQ(e.interior_false_lit, 0u);
}

TEST(Metrics, InteriorNeedsMoreThanThreePixels) {
  const ErrorFigures at_three = measure({{".....####"}, {".#...####"}});  // edge pixels are 4 and 5
  EXPECT_EQ(at_three.interior_false_shadow, 0u);
  EXPECT_DOUBLE_EQ(at_three.boundary_fraction, 1.0 / 8);
  const ErrorFigures at_four = measure({{".....####"}, {"#....####"}});
  EXPECT_EQ(at_four.interior_false_shadow, 1u);
  EXPECT_EQ(at_four.boundary_fraction, 0);
  EXPECT_EQ(measure({{".....#####"}, {".....####."}}).interior_false_lit, 1u);
}

TEST(Metrics, WithoutAnEdgeEverythingIsInterior) {
  const ErrorFigures e = measure({{"....", "...."}, {"#...", "...."}});
  EXPECT_EQ(e.interior_false_shadow, 1u);
  EXPECT_EQ(e.boundary_fraction, 0);
}

TEST(Metrics, NothingComparedIsZeroNotUndefined) {
  const ErrorFigures e = measure({{"  ", "  "}, {".#", "#."}});
  EXPECT_EQ(e.compared, 0u);
  EXPECT_EQ(e.wrong, 0u);
  EXPECT_EQ(e.fraction, 0);
  EXPECT_EQ(e.match, 1);
  EXPECT_EQ(e.mean_absolute, 0);
  const ErrorFigures empty = measure({{}, {}});
  EXPECT_EQ(empty.image_pixels, 0u);
  EXPECT_EQ(empty.match, 1);
}

TEST(Metrics, MeanAbsoluteIsAgainstTheFilteredReference) {
  Picture picture({"..# "}, {".+#."});
  EXPECT_DOUBLE_EQ(measure(picture).mean_absolute, 0.25 / 3);
  picture.reference_filtered = {1.0f, 0.5f, 0.25f, 0.0f};
  EXPECT_DOUBLE_EQ(measure(picture).mean_absolute, 0.5 / 3);
}

TEST(Metrics, OracleIsComparedWithTheAnswerNotTheTruth) {
  Picture picture({"...# "}, {"##.#."});
  picture.oracle = {0, 0, 1, 1, 0};
  EXPECT_DOUBLE_EQ(*measure(picture).oracle_fraction, 0.25);
}

TEST(Metrics, AFeatureThinnerThanATexelIsExcepted) {
  // A sheet over x in [7.5, 8.5] crosses the whole picture between pixels' rows of sight: the truth image does not show
  // it, the technique says all is dark. Texels of 2 m reach it from x = 5.5 to 10.5 with samples 1 m apart.
  Picture picture(uniform(16, 1, '.'), uniform(16, 1, '#'));
  picture.reference[8] = 0;
  picture.facing[8] = 0;
  const Tracer tracer(sheet(7.5f, -50, 8.5f, 50));
  const ErrorFigures strict = measure_error(picture.input(), tracer, zenith());
  EXPECT_EQ(strict.interior_false_shadow, 15u);
  picture.set_texel(1.0f);
  const ErrorFigures e = measure_error(picture.input(), tracer, zenith());
  EXPECT_EQ(e.wrong, 15u);
  EXPECT_EQ(e.false_shadow, 15u);
  EXPECT_EQ(e.interior_false_shadow, 11u);  // 6, 7, 9 and 10 see the sheet within a texel
}

TEST(Metrics, ATexelWithoutExtentExceptsNothing) {
  Picture picture(uniform(8, 2, '.'), uniform(8, 2, '#'));
  const Tracer tracer(sheet(3.4f, -50, 3.6f, 50));
  picture.set_texel(0);
  EXPECT_EQ(measure_error(picture.input(), tracer, zenith()).interior_false_shadow, 16u);
  picture.set_texel(std::numeric_limits<float>::infinity());
  EXPECT_EQ(measure_error(picture.input(), tracer, zenith()).interior_false_shadow, 16u);
}

TEST(Metrics, LeavingTheConeIsNoFeature) {
  Light spot;
  spot.kind = LightKind::spot;
  spot.position = {4, 10, 0};
  spot.direction = {0, -1, 0};
  spot.outer_angle = std::atan(0.35);  // reaches x = 0.5 .. 7.5
  Picture picture({" ....... "}, {"#########"});
  picture.set_texel(0.5f);
  const Tracer tracer(sheet(1000, 1000, 1001, 1001));
  EXPECT_EQ(facing_light(picture.points, spot), picture.facing);
  EXPECT_EQ(measure_error(picture.input(), tracer, spot).interior_false_shadow, 7u);
}

TEST(Metrics, FacingLight) {
  const std::vector<SurfacePoint> points = {{{0, 0, 0}, {0, 1, 0}},
                                            {{0, 0, 0}, {0, -1, 0}},
                                            {{0, 0, 0}, {1, 0, 0}},
                                            {{0, 0, 0}, {0, 0, 0}},
                                            {{5, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(facing_light(points, zenith()), (std::vector<uint8_t>{1, 0, 0, 0, 1}));
  Light light;
  light.kind = LightKind::point;
  light.position = {1, 1, 0};
  EXPECT_EQ(facing_light(points, light), (std::vector<uint8_t>{1, 0, 1, 0, 1}));
  light.kind = LightKind::spot;
  light.outer_angle = glm::radians(50.0);
  EXPECT_EQ(facing_light(points, light), (std::vector<uint8_t>{1, 0, 1, 0, 0}));
}

TEST(Metrics, EdgeOnSurfacesAreNotCompared) {
  Light light = zenith();
  light.direction = glm::normalize(glm::dvec3(1e-5, -1, 0));
  const std::vector<SurfacePoint> wall = {{{0, 0, 0}, {-1, 0, 0}}};
  EXPECT_EQ(facing_light(wall, light), std::vector<uint8_t>{0});
  light.direction = glm::normalize(glm::dvec3(1e-3, -1, 0));
  EXPECT_EQ(facing_light(wall, light), std::vector<uint8_t>{1});
  light.kind = LightKind::point;
  light.position = {-1e-5, 1, 0};
  EXPECT_EQ(facing_light(wall, light), std::vector<uint8_t>{0});
  light.position = {-1e-3, 1, 0};
  EXPECT_EQ(facing_light(wall, light), std::vector<uint8_t>{1});
}

TEST(Metrics, ImagesOfOtherSizesAreRefused) {
  Picture picture({"..", ".."}, {"..", ".."});
  MetricsInput input = picture.input();
  input.visibility = input.visibility.first(3);
  const Tracer tracer(sheet(0, 0, 1, 1));
  EXPECT_THROW(measure_error(input, tracer, zenith()), InputError);
  input = picture.input();
  picture.set_texel(1);
  input.texel_u = picture.texel_u;
  EXPECT_THROW(measure_error(input, tracer, zenith()), InputError);
}

TEST(Metrics, AgreesWithTheDefinitionsOnRandomImages) {
  constexpr uint32_t seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto draw = [&](const char* letters, size_t n) { return letters[random() % n]; };
  for (int round = 0; round < 20; ++round) {
    const int width = 1 + static_cast<int>(random() % 60), height = 1 + static_cast<int>(random() % 60);
    auto truth = uniform(static_cast<size_t>(width), static_cast<size_t>(height), '.');
    auto answer = truth;
    for (auto& row : answer)
      for (char& c : row) c = draw(".#", 2);
    // A few dark or uncompared specks, so that there is an interior.
    for (int k = 0; k < 6; ++k) truth[random() % truth.size()][random() % static_cast<size_t>(width)] = draw("# ", 2);
    const auto at = [&](const std::vector<std::string>& image, int x, int y) {
      return x < 0 || y < 0 || x >= width || y >= height ? ' ' : image[static_cast<size_t>(y)][static_cast<size_t>(x)];
    };
    const auto is_edge = [&](int x, int y) {
      const char c = at(truth, x, y);
      const char other = c == '.' ? '#' : '.';
      return c != ' ' && (at(truth, x - 1, y) == other || at(truth, x + 1, y) == other ||
                          at(truth, x, y - 1) == other || at(truth, x, y + 1) == other);
    };
    uint64_t edges = 0, boundary = 0, boundary_wrong = 0, interior_shadow = 0, interior_lit = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (at(truth, x, y) == ' ') continue;
        edges += is_edge(x, y);
        bool close = false;
        for (int dy = -3; dy <= 3; ++dy)
          for (int dx = -3; dx <= 3; ++dx) close = close || (dx * dx + dy * dy <= 9 && is_edge(x + dx, y + dy));
        const bool wrong = at(truth, x, y) != at(answer, x, y);
        boundary += close;
        boundary_wrong += close && wrong;
        interior_shadow += wrong && !close && at(truth, x, y) == '.';
        interior_lit += wrong && !close && at(truth, x, y) == '#';
      }
    const ErrorFigures e = measure({truth, answer});
    EXPECT_EQ(e.edge_pixels, edges);
    EXPECT_EQ(e.interior_false_shadow, interior_shadow);
    EXPECT_EQ(e.interior_false_lit, interior_lit);
    EXPECT_DOUBLE_EQ(e.boundary_fraction,
                     boundary == 0 ? 0.0 : static_cast<double>(boundary_wrong) / static_cast<double>(boundary));
  }
}

TEST(Metrics, TotalIsTheErrorOfAllFramesTogether) {
  // One image cut in two by a row that is not compared, far enough for boundaries not to meet.
  const std::vector<std::string> top{"....####", "....####"}, bottom{".#######", "........"};
  const std::vector<std::string> top_answer{"..######", "....####"}, bottom_answer{"..######", ".....#.."};
  const auto together = [](std::vector<std::string> a, const std::vector<std::string>& b) {
    for (int i = 0; i < 4; ++i) a.emplace_back("        ");
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const ErrorFigures whole = measure({together(top, bottom), together(top_answer, bottom_answer)});
  const std::vector<ErrorFigures> parts{measure({top, top_answer}), measure({bottom, bottom_answer})};
  const ErrorFigures sum = total(parts);
  EXPECT_EQ(sum.wrong, whole.wrong);
  EXPECT_EQ(sum.compared, whole.compared);
  EXPECT_EQ(sum.false_shadow, whole.false_shadow);
  EXPECT_EQ(sum.false_lit, whole.false_lit);
  EXPECT_EQ(sum.edge_pixels, whole.edge_pixels);
  EXPECT_EQ(sum.boundary_pixels, whole.boundary_pixels);
  EXPECT_DOUBLE_EQ(sum.fraction, whole.fraction);
  EXPECT_DOUBLE_EQ(sum.boundary_fraction, whole.boundary_fraction);
  EXPECT_DOUBLE_EQ(sum.mean_absolute, whole.mean_absolute);
  EXPECT_FALSE(sum.oracle_fraction);
  EXPECT_EQ(total({}).match, 1);
}

}  // namespace
}  // namespace shadewright::compare
