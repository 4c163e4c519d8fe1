// Powder dissolves in water [MLSRK Figures 5 and 12]: in 2D at the paper's size, 1,876 points at 10 mm; in 3D
// at 6 mm, since the paper's 2 mm take days.

#include <gtest/gtest.h>

#include "tests/scenes/dissolution.h"

namespace lather::testing_support {
namespace {

TEST(DissolvingPowder, KeepsItsMassAndThatOfTheWater) {
  expect_powder_keeps_its_masses("paper", 0.02, 0);
}

// Half a spacing of the thirteen that the paste is deep.
TEST(Starch, FloatsThenDissolvesAndTakesAsMuchRoomAsItsDensityCurveSays) {
  expect_starch_floats_and_dissolves("coarse", 0.04, 0);
}

}  // namespace
}  // namespace lather::testing_support
