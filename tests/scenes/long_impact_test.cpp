// The dropped spheres and penguins at the paper's size, from the impact to the rebound's top.
//
// The printed step is 5e-6 s. These runs take the step that the plan chooses, ten times as long, which the
// blend per time allows, and resample every 1 ms, 5 % of shear apart in a body that is sheared at 50/s.

#include <gtest/gtest.h>

#include "tests/scenes/impact.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

struct Run {
  Scene scene;
  Impact impact;
};

Run drop(const std::string& name, double duration) {
  Run run;
  run.scene = scene_file(name, "paper",
                         {{"/numerics/time_step", "0"},
                          {"/numerics/resampling/interval", "1e-3"},
                          {"/duration", std::to_string(duration)}});
  run.impact = measure_impact(run.scene, run_scene(run.scene, 0));
  print(name, run.impact);
  return run;
}

void expect_rebound(const Impact& impact) {
  EXPECT_GT(impact.climb, 0.05 * impact.drop_height);
}

void expect_splat(const Run& run) {
  EXPECT_LT(run.impact.climb, 0.01 * run.impact.drop_height);
  EXPECT_LT(run.impact.lift, run.scene.spacing);
}

// Lands after 0.04 s.
TEST(ImpactAtThePapersSize, OobleckSphereRebounds) {
  expect_rebound(drop("oobleck-sphere", 0.15).impact);
}

TEST(ImpactAtThePapersSize, ViscoplasticSphereStays) {
  expect_splat(drop("viscoplastic-sphere", 0.15));
}

TEST(ImpactAtThePapersSize, OobleckPenguinReboundsAndFlowsLater) {
  const Impact impact = drop("oobleck-penguin", 0.6).impact;
  expect_rebound(impact);
  EXPECT_LT(impact.final_height, 0.5 * impact.body_height);
}

TEST(ImpactAtThePapersSize, ViscoplasticPenguinStays) {
  expect_splat(drop("viscoplastic-penguin", 0.3));
}

}  // namespace
}  // namespace lather::testing_support
