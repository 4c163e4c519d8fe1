// The pseudo-dog [MLSRK Figure 11] at the paper's spacing, 1 mm, with 60 hairs: 15,320 points, where the
// paper's size has 520,436.

#include <gtest/gtest.h>

#include "tests/scenes/dog.h"

namespace lather::testing_support {
namespace {

TEST(PseudoDog, ShakesOffTheWaterAndKeepsItsHairs) {
  const ShakeOff spun = run_shake_off("", {}, 0);
  EXPECT_GT(spun.wettest, 0.15);
  EXPECT_LT(spun.wet, 0.5 * spun.wettest);
  EXPECT_EQ(spun.lost, 0U);
}

}  // namespace
}  // namespace lather::testing_support
