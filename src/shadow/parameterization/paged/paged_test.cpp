// Paged maps against ray tracing, and what their counters promise.
#include "shadewright/compare/path_study.h"
#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"
#include "shadow/parameterization/paged/paged_for_test.h"

namespace shadewright::compare {
namespace {

/// A texel a pixel: what is wrong lies along the edges, and the texel that is asked holds what the oracle says.
TEST_F(PagedTest, ShadowsAreRightUpToAPixel) {
  for (const char* name : {"spheres", "city"}) {
    SCOPED_TRACE(name);
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
    const TechniqueResult hard = run(study, "paged/depth/hard,statistics=on");
    EXPECT_LE(*hard.error.oracle_fraction, 5e-4);
    EXPECT_LE(static_cast<double>(hard.error.wrong), 0.2 * static_cast<double>(hard.error.edge_pixels));
    const TechniqueResult trilinear = run(study, "rmsm,statistics=on");
    EXPECT_LE(static_cast<double>(trilinear.error.wrong), 0.2 * static_cast<double>(trilinear.error.edge_pixels));
    for (const TechniqueResult* result : {&hard, &trilinear}) {
      EXPECT_GT(counter(*result, "taps"), 0);
      EXPECT_EQ(counter(*result, "coarser_taps"), 0);
      EXPECT_EQ(counter(*result, "unserved_taps"), 0);
      EXPECT_EQ(counter(*result, "clusters_not_drawn"), 0);
      EXPECT_EQ(counter(*result, "pages"), counter(*result, "unique_requests"));
    }
  }
}

/// Sub-pixel triangles in pages of texels of a pixel's size: borders that depths get right to a pixel only, across
/// pages' borders too.
TEST_F(PagedTest, KeepsSubPixelTriangles) {
  for (const char* name : {"spheres", "city"}) {
    SCOPED_TRACE(name);
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
    const TechniqueResult depth = run(study, "paged/depth/hard"),
                          triangles = run(study, "paged/subpixel/hard,statistics=on");
    EXPECT_LE(triangles.error.wrong, depth.error.wrong / 4);
    EXPECT_LE(static_cast<double>(triangles.error.wrong), 0.03 * static_cast<double>(triangles.error.edge_pixels));
    EXPECT_EQ(counter(triangles, "coarser_taps"), 0);
    EXPECT_EQ(counter(triangles, "unserved_taps"), 0);
    EXPECT_EQ(counter(triangles, "clusters_not_drawn"), 0);
    EXPECT_GT(counter(triangles, "decided_by_recovery"), 0);
    EXPECT_THROW(run(study, "paged/subpixel,analysis_scale=2"), InputError);
  }
}

/// The paper's list of requests, sorted and made unique, names the pages that the bitmask does.
TEST_F(PagedTest, SortedRequestsAskForTheSamePages) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
  for (const std::string spec : {"rmsm", "paged/depth/hard"}) {
    SCOPED_TRACE(spec);
    const Outcome bits = study.run(shadow::parse_spec(spec)),
                  sorted = study.run(shadow::parse_spec(spec + ",requests=sort"));
    const double unique = counter(bits.result, "unique_requests");
    EXPECT_EQ(counter(sorted.result, "unique_requests"), unique);
    EXPECT_EQ(counter(sorted.result, "sorted_unique_requests"), unique);
    EXPECT_EQ(counter(sorted.result, "raw_requests"), counter(bits.result, "raw_requests"));
    EXPECT_GT(counter(sorted.result, "compacted_requests"), unique);
    EXPECT_LT(counter(sorted.result, "compacted_requests"), counter(bits.result, "raw_requests"));
    EXPECT_EQ(sorted.visibility, bits.visibility);
  }
}

/// A pool that can't hold what is asked for makes everything coarser, and nothing wrong.
TEST_F(PagedTest, AFullPoolDropsTheFinestLevels) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const TechniqueResult full = run(study, "paged/depth/hard,pool=1024,statistics=on");
  EXPECT_GT(counter(full, "dropped_levels"), 0);
  EXPECT_LE(counter(full, "pages"), 1024);
  EXPECT_EQ(counter(full, "coarser_taps"), 0);
  EXPECT_EQ(counter(full, "unserved_taps"), 0);
  EXPECT_LE(*full.error.oracle_fraction, 5e-4);
}

/// A bound on the finest level takes fewer pages, and every request is still served.
TEST_F(PagedTest, AsksForNothingFinerThanTold) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const TechniqueResult all = run(study, "rmsm,statistics=on"), bounded = run(study, "rmsm,finest=4096,statistics=on");
  EXPECT_LT(counter(bounded, "pages"), 0.8 * counter(all, "pages"));
  EXPECT_EQ(counter(bounded, "effective_resolution"), 4096);
  EXPECT_GT(bounded.error.wrong, all.error.wrong);
  for (const char* name : {"coarser_taps", "unserved_taps", "dropped_levels"})
    EXPECT_EQ(counter(bounded, name), 0) << name;
  EXPECT_THROW(run(study, "rmsm,finest=5000"), InputError);
}

/// Where pixels are left out of the analysis, coarser pages answer for the few that nobody asked for.
TEST_F(PagedTest, ACoarserAnalysisMissesLittle) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const TechniqueResult all = run(study, "rmsm,statistics=on"),
                        some = run(study, "rmsm,analysis_scale=4,statistics=on");
  EXPECT_NEAR(counter(some, "raw_requests"), counter(all, "raw_requests") / 16, 0.01 * counter(all, "raw_requests"));
  EXPECT_EQ(counter(some, "unserved_taps"), 0);
  EXPECT_GT(counter(some, "coarser_taps"), 0);
  EXPECT_LT(counter(some, "coarser_taps"), 0.05 * counter(some, "taps"));
  EXPECT_LE(static_cast<double>(some.error.wrong), 1.1 * static_cast<double>(all.error.wrong));
}

TEST_F(PagedTest, ServesSpotAndPointLights) {
  const Scene scene = make_builtin("sandbox");
  for (const LightKind kind : {LightKind::spot, LightKind::point}) {
    Study study(device(), scene, scene.cameras.front(), lamp(scene, kind), small());
    for (const char* spec : {"paged/depth/hard@8192,statistics=on", "rmsm@8192,statistics=on",
                             "paged/subpixel/hard@8192,pool=2048,statistics=on"}) {
      const TechniqueResult result = run(study, spec);
      SCOPED_TRACE(spec);
      EXPECT_LE(result.error.oracle_fraction.value_or(0), 5e-4);
      EXPECT_GE(result.error.match, 0.98);
      EXPECT_EQ(counter(result, "coarser_taps"), 0);
      EXPECT_EQ(counter(result, "unserved_taps"), 0);
    }
  }
}

TEST_F(PagedTest, EveryResolutionWorks) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  // At 384 x 384 a texel of 1,024 is about a pixel: finer maps change nothing but where texels' borders fall.
  for (const char* spec : {"paged@1024", "paged@4096", "paged@131072"}) {
    const TechniqueResult result = run(study, spec);
    EXPECT_LE(*result.error.oracle_fraction, 5e-4) << spec;
    EXPECT_LE(static_cast<double>(result.error.wrong), 0.12 * static_cast<double>(result.error.edge_pixels)) << spec;
  }
  EXPECT_THROW(run(study, "paged@5000"), InputError);
}

/// Kept pages hold what freshly drawn ones would, and nothing is drawn twice.
TEST_F(PagedTest, ACachedFrameThatSeesNothingNewDrawsNothing) {
  const Scene scene = make_builtin("city");
  StudyOptions options = small();
  options.repeat = 2;
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), options);
  for (const std::string spec : {"rmsm", "paged/subpixel/hard"}) {
    SCOPED_TRACE(spec);
    const Outcome fresh = study.run(shadow::parse_spec(spec)), kept = study.run(shadow::parse_spec(spec + ",cache=on"));
    EXPECT_GT(counter(fresh.result, "pages_drawn"), 0);
    EXPECT_EQ(counter(kept.result, "pages_drawn"), 0);
    EXPECT_EQ(counter(kept.result, "flushes"), 1);
    EXPECT_EQ(kept.visibility, fresh.visibility);
  }
}

/// Over a path with casters that move, and with a light that moves, kept pages show what freshly drawn ones do, and no
/// request is left unserved in any frame.
TEST_F(PagedTest, KeptPagesFollowWhatMoves) {
  for (const bool light_moves : {false, true}) {
    const Scene scene = make_builtin(light_moves ? "sandbox" : "characters");
    std::vector<Moment> moments;
    for (int i = 0; i < 3; ++i) {
      Moment moment{0.3 * i, scene.cameras.front(), scene.lights.front()};
      if (light_moves) moment.light = sun(52 + 4 * i, 31 + i);
      moments.push_back(moment);
    }
    PathStudy study(device(), scene, "moving", moments, {256, 256, 0, 0, true});
    const std::vector<shadow::Spec> specs{shadow::parse_spec("paged/depth/hard@16384,statistics=on"),
                                          shadow::parse_spec("paged/depth/hard@16384,cache=on,statistics=on")};
    study.run(specs, {}, [&](uint32_t frame, std::span<const Outcome> outcomes) {
      SCOPED_TRACE(frame);
      for (const Outcome& outcome : outcomes) {
        EXPECT_EQ(counter(outcome.result, "coarser_taps"), 0);
        EXPECT_EQ(counter(outcome.result, "unserved_taps"), 0);
        EXPECT_EQ(counter(outcome.result, "clusters_not_drawn"), 0);
        EXPECT_LE(*outcome.result.error.oracle_fraction, 5e-4);
      }
      if (frame == 0 || light_moves) return;
      EXPECT_LT(counter(outcomes[1].result, "pages_drawn"), counter(outcomes[0].result, "pages_drawn"));
    });
  }
}

/// The camera flies from one view to the other; the sun moves in the first half of the frames and rests in the second.
TEST_F(PagedTest, ServesEveryRequestOfAFlight) {
  for (const auto& flight : {std::pair("furball", 16u), std::pair("characters", 120u)}) {
    const uint32_t frames = flight.second;
    SCOPED_TRACE(flight.first);
    const Scene scene = make_builtin(flight.first);
    const Camera &from = scene.cameras.front(), &to = scene.cameras.back();
    std::vector<Moment> moments;
    for (uint32_t i = 0; i < frames; ++i) {
      const double along = i / (frames - 1.0);
      Camera camera = from;
      camera.eye = glm::mix(from.eye, to.eye, along);
      camera.target = glm::mix(from.target, to.target, along);
      const double turn = std::min(i, frames / 2);
      moments.push_back({i / 30.0, camera, sun(40 + 0.5 * turn, 35 + 0.2 * turn)});
    }
    PathStudy study(device(), scene, "flight", moments, {96, 64, 0, 0, false});
    double rested = 0;
    study.run(std::vector{shadow::parse_spec("rmsm@8192,cache=on,statistics=on")}, {},
              [&](uint32_t frame, std::span<const Outcome> outcomes) {
                SCOPED_TRACE(frame);
                const TechniqueResult& result = outcomes.front().result;
                EXPECT_GT(counter(result, "taps"), 0);
                EXPECT_EQ(counter(result, "coarser_taps"), 0);
                EXPECT_EQ(counter(result, "unserved_taps"), 0);
                EXPECT_EQ(counter(result, "dropped_levels"), 0);
                EXPECT_EQ(counter(result, "clusters_not_drawn"), 0);
                if (frame > frames / 2) rested += counter(result, "pages_drawn") / counter(result, "pages");
              });
    EXPECT_LT(rested / (frames / 2), 0.9);  // most pages are kept where only the camera moves
  }
}

/// Refinement along edges asks for fewer pages, in several rounds.
TEST_F(PagedTest, RefinesEdges) {
  const Scene scene = make_builtin("city");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const TechniqueResult all = run(study, "rmsm@16384"), edges = run(study, "asm@16384");
  EXPECT_GT(counter(edges, "iterations"), 2);
  EXPECT_LT(counter(edges, "iterations"), 20);
  EXPECT_LT(counter(edges, "pages"), counter(all, "pages") + 1024);
  EXPECT_GE(edges.error.match, 0.97);
}

}  // namespace
}  // namespace shadewright::compare
