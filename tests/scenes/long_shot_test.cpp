// The shot figure [MLSRK Figure 8] at the paper's size: about 240,000 points at 10 mm.

#include <gtest/gtest.h>

#include "tests/scenes/shot.h"

namespace lather::testing_support {
namespace {

TEST(Shooting, SmashesTheFigureAndHandsMomentumOver) {
  const Shot s = run_shot("paper", {}, 0);
  EXPECT_GT(s.pieces, 1U);
  EXPECT_GT(s.handed_over, 0.1);
}

}  // namespace
}  // namespace lather::testing_support
