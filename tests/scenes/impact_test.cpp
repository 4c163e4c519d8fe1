// The dropped spheres and penguins [Foam Fig. 13]: oobleck rebounds, then flows; its Bingham twin, alike in
// all but the flow index, flows at once.

#include "tests/scenes/impact.h"

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

Impact drop(const std::string& name, double duration) {
  const Scene scene = scene_file(name, "preview", {{"/duration", std::to_string(duration)}});
  const Impact impact = measure_impact(scene, run_scene(scene, 1));
  print(name, impact);
  return impact;
}

class Dropped : public testing::TestWithParam<std::string> {};

TEST_P(Dropped, OobleckReboundsAndFlowsLater) {
  const Impact impact = drop("oobleck-" + GetParam(), 0.6);
  EXPECT_GT(impact.climb, 0.05 * impact.drop_height);
  EXPECT_LT(impact.final_height, 0.5 * impact.body_height);
}

// It lies still after 0.2 s.
TEST_P(Dropped, ViscoplasticFlowsAtOnceAndStays) {
  const Impact impact = drop("viscoplastic-" + GetParam(), 0.3);
  const Scene scene = scene_file("viscoplastic-" + GetParam(), "preview");
  EXPECT_LT(impact.climb, 0.01 * impact.drop_height);
  EXPECT_LT(impact.lift, scene.spacing);
  EXPECT_LT(impact.final_height, 0.5 * impact.body_height);
}

INSTANTIATE_TEST_SUITE_P(Body, Dropped, testing::Values("sphere", "penguin"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lather::testing_support
