// Powder dissolves in water [MLSRK Figures 5 and 12]: in 2D at the paper's size, 1,876 points at 10 mm; in 3D
// at 6 mm, since the paper's 2 mm take days.

#include <gtest/gtest.h>

#include "tests/scenes/dissolution.h"

namespace lather::testing_support {
namespace {

TEST(DissolvingPowder, KeepsItsMassAndThatOfTheWater) {
  const Dissolution kept = run_dissolution("dissolving-powder-2d", "paper", 0.4, {}, 0);
  EXPECT_LT(kept.component_drift, 1e-7);
  EXPECT_GT(kept.shrinkage, 0.1);
  const Dissolution lost = run_dissolution("dissolving-powder-2d", "paper", 0.4,
                                           {{"/numerics/mlsrk/phases/balance", "\"concentration\""}}, 0);
  EXPECT_GT(lost.component_drift, 0.02);
}

TEST(Starch, FloatsThenDissolvesAndTakesAsMuchRoomAsItsDensityCurveSays) {
  const Dissolution d = run_dissolution("starch", "coarse", 0.1, {}, 0);
  EXPECT_GT(d.floating, 0.5);
  EXPECT_GT(d.dry_first, 0.5);
  EXPECT_EQ(d.dry_last, 0);
  EXPECT_NEAR(d.shrinkage, d.full_shrinkage, 0.05 * d.full_shrinkage);
  // Half a spacing of the thirteen that the paste is deep.
  EXPECT_NEAR(d.volume_error, 0, 0.04);
}

}  // namespace
}  // namespace lather::testing_support
