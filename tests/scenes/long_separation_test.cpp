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

// 6,400 points on 10 mm cells, then 25,600 on 5 mm cells with steps of 5e-5 s, as in the paper's Table 2.
TEST(MixtureDamBreak, NoGridOfAsManyPointsOrNodesPartsTheLiquids) {
  const ComparedSeparation by = compare_separations("paper", 2.25, 5e-5, 0);
  EXPECT_EQ(by.equal_points.points, by.particles.points);
  EXPECT_EQ(by.equal_nodes.points, 4 * by.particles.points);
  for (const Separation& grid : {by.equal_points, by.equal_nodes}) {
    EXPECT_LT(grid.end, 0.1);
    EXPECT_GT(by.particles.end, grid.end + 0.2);
  }
}

}  // namespace
}  // namespace lather::testing_support
