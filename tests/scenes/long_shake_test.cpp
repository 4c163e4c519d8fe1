// Shaving cream under a shaken block at the paper's size: 55,000 points at 3 mm. The printed step is 1e-5 s;
// these runs take the one that the plan chooses, three times as long.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/scene_run.h"
#include "tests/scenes/shake.h"

namespace lather::testing_support {
namespace {

TEST(ShakeAtThePapersSize, TearsInThePapersOrderAndKeepsItsVolumeAndDensity) {
  const Scene scene = scene_file("shaving-cream-shake", "paper");
  const Shake foam = shake("paper", 0.65, {}, 0);
  const Held worst = held(foam.report);
  EXPECT_LT(worst.density_off, 0.0089);
  EXPECT_GT(worst.least_within_5_percent, 0.95);
  EXPECT_GE(worst.fewest_interior_nodes, 200U);
  EXPECT_LT(worst.skin_off, 0.027);

  const Shake perfect = shake("paper", 0.45, perfectly_plastic(scene), 0);
  EXPECT_LT(perfect.tear_time, foam.tear_time);
  ASSERT_TRUE(std::isfinite(foam.tear_time));
  const Shake viscous = shake("paper", foam.tear_time + 3 * kTornFor, viscoplastic(scene), 0);
  EXPECT_GT(viscous.tear_time, foam.tear_time + kTornFor);
}

}  // namespace
}  // namespace lather::testing_support
