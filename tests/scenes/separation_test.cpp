// A dam of two liquids that are mixed point by point breaks [MLSRK Figure 3] at preview: 400 points at 20 mm.

#include "tests/scenes/separation.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(MixtureDamBreak, TheHeavyLiquidGathersBelowTheLightOne) {
  const Separation s = run_separation("preview", {}, 1);
  EXPECT_LT(s.start, 0.25);
  EXPECT_GT(s.middle, s.start + 0.1);
  EXPECT_GT(s.end, s.middle);
  EXPECT_GT(s.end, 0.5);
}

// What gathers them is the difference of densities: of two names for one liquid none sinks. Of 400 points
// that are drawn at random mean heights differ by about 0.1 of the full separation.
TEST(MixtureDamBreak, LiquidsOfOneDensityStayMixed) {
  const Separation s = run_separation("preview", {{"/materials/0/density", "1000"}}, 1);
  EXPECT_LT(std::abs(s.end), 0.25);
}

// On a grid, points of both liquids in one cell get the same acceleration, so that neither can sink through
// the other; more nodes do not help. The paper's finer grid takes half the step.
TEST(MixtureDamBreak, NoGridOfAsManyPointsOrNodesPartsTheLiquids) {
  const ComparedSeparation by = compare_separations("preview", 2.25, 2e-4, 1);
  EXPECT_EQ(by.equal_points.points, by.particles.points);
  EXPECT_EQ(by.equal_nodes.points, 4 * by.particles.points);
  for (const Separation& grid : {by.equal_points, by.equal_nodes}) {
    EXPECT_LT(grid.end, 0.25);
    EXPECT_GT(by.particles.end, grid.end + 0.25);
  }
}

}  // namespace
}  // namespace lather::testing_support
