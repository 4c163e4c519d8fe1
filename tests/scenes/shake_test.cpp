// Shaving cream under a shaken block at preview size [Foam Figs. 1, 3].

#include "tests/scenes/shake.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

TEST(Shake, TearsInThePapersOrderAndKeepsItsVolume) {
  const Scene scene = scene_file("shaving-cream-shake", "preview");
  const Shake foam = shake("preview", 0.6, {}, 1);
  const Shake perfect = shake("preview", 0.45, perfectly_plastic(scene), 1);
  EXPECT_LT(perfect.tear_time, foam.tear_time);
  ASSERT_TRUE(std::isfinite(foam.tear_time));
  const Shake viscous = shake("preview", foam.tear_time + 3 * kTornFor, viscoplastic(scene), 1);
  EXPECT_GT(viscous.tear_time, foam.tear_time + kTornFor);

  // The paper's bounds on density. So coarse a body has few nodes that lie wholly inside: 13 to 37.
  const Held worst = held(foam.report);
  EXPECT_LT(worst.density_off, 0.0089);
  EXPECT_GT(worst.least_within_5_percent, 0.95);
  EXPECT_GT(worst.fewest_interior_nodes, 10U);
  // An error of the surface's place, in distances of points: 2.7 % of the paper's 55,000 points.
  const auto points = static_cast<double>(foam.report.frames.front().points);
  EXPECT_LT(worst.skin_off, 0.027 * std::cbrt(55000 / points));
}

}  // namespace
}  // namespace lather::testing_support
