// The rolling snowball [MLSRK Figure 2] at the paper's size: 3D at 5 mm, about 6,000 points and 3,000 fixed
// ones.

#include <gtest/gtest.h>

#include "tests/scenes/snowball.h"

namespace lather::testing_support {
namespace {

TEST(Snowball, GrowsAsItRollsAndBreaksOnTheStack) {
  const Roll roll = run_roll("paper", {}, 0);
  EXPECT_GT(roll.grown[1], roll.grown[0]);
  EXPECT_GT(roll.grown[2], roll.grown[1]);
  EXPECT_GT(roll.whole, 0.95);
  EXPECT_GT(roll.pieces, 1U);
  EXPECT_LT(roll.largest, 0.9);
}

}  // namespace
}  // namespace lather::testing_support
