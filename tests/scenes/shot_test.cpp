// A cannonball on a given path smashes a figure of jelly [MLSRK Figure 8] at preview: spacing 40 mm.

#include "tests/scenes/shot.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(Shooting, SmashesTheFigureAndHandsMomentumOver) {
  const Shot s = run_shot("preview", {}, 1);
  EXPECT_GT(s.pieces, 1U);
  EXPECT_GT(s.handed_over, 0.3);
}

}  // namespace
}  // namespace lather::testing_support
