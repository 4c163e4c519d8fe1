// Powder dissolves in water [MLSRK Figures 5 and 12] at preview: 469 points at 20 mm in 2D, 760 at 12 mm in
// 3D.

#include "tests/scenes/dissolution.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

// Flows are added up in single precision, in some thousand steps: the errors of 6e-8 of a flow each make up
// far less than 1e-7 of the sum.
TEST(DissolvingPowder, KeepsItsMassAndThatOfTheWater) {
  const Dissolution kept = run_dissolution("dissolving-powder-2d", "preview", 0.4, {}, 1);
  EXPECT_LT(kept.component_drift, 1e-7);
  EXPECT_GT(kept.shrinkage, 0.1);
  const Dissolution lost = run_dissolution("dissolving-powder-2d", "preview", 0.4,
                                           {{"/numerics/mlsrk/phases/balance", "\"concentration\""}}, 1);
  EXPECT_GT(lost.component_drift, 0.01);
}

TEST(Starch, FloatsThenDissolvesAndTakesAsMuchRoomAsItsDensityCurveSays) {
  const Dissolution d = run_dissolution("starch", "preview", 0.1, {}, 1);
  EXPECT_GT(d.floating, 0.5);
  EXPECT_GT(d.dry_first, 0.5);
  EXPECT_EQ(d.dry_last, 0);
  // The paste is of one concentration to a few per cent by then.
  EXPECT_NEAR(d.shrinkage, d.full_shrinkage, 0.05 * d.full_shrinkage);
  // A third of a spacing of the six to seven that the paste is deep.
  EXPECT_NEAR(d.volume_error, 0, 0.05);
}

}  // namespace
}  // namespace lather::testing_support
