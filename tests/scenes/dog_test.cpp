// A pseudo-dog, a rigid body with hairs of 2 x 2 points, shakes off water [MLSRK Figure 11] at preview: 16
// hairs at 2 mm.

#include "tests/scenes/dog.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(PseudoDog, ShakesOffTheWaterAndKeepsItsHairs) {
  const ShakeOff spun = run_shake_off("preview", {}, 1);
  EXPECT_GT(spun.wettest, 0.15);
  EXPECT_LT(spun.wet, 0.08);
  EXPECT_EQ(spun.lost, 0U);
}

TEST(PseudoDog, StaysWetAtRest) {
  const ShakeOff still = run_shake_off("preview", {{"/grips/0/motion", R"({"type": "rest"})"}}, 1);
  EXPECT_GT(still.wet, 0.16);  // twice what the one that spins may keep
}

}  // namespace
}  // namespace lather::testing_support
