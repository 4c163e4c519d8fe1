// The mixture dam break [MLSRK Figure 3] at the paper's size: 6,400 points at 5 mm, steps of 1e-4 s.

#include <gtest/gtest.h>

#include "tests/scenes/separation.h"

namespace lather::testing_support {
namespace {

TEST(MixtureDamBreak, TheHeavyLiquidGathersBelowTheLightOne) {
  const Separation s = run_separation("paper", {}, 0);
  EXPECT_LT(s.start, 0.1);
  EXPECT_GT(s.middle, s.start + 0.1);
  EXPECT_GT(s.end, s.middle);
}

}  // namespace
}  // namespace lather::testing_support
