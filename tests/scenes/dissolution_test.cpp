// Powder dissolves in water [MLSRK Figures 5 and 12] at preview: 469 points at 20 mm in 2D, 760 at 12 mm in
// 3D.

#include "tests/scenes/dissolution.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(DissolvingPowder, KeepsItsMassAndThatOfTheWater) {
  expect_powder_keeps_its_masses("preview", 0.01, 1);
}

// A third of a spacing of the six to seven that the paste is deep.
TEST(Starch, FloatsThenDissolvesAndTakesAsMuchRoomAsItsDensityCurveSays) {
  expect_starch_floats_and_dissolves("preview", 0.05, 1);
}

}  // namespace
}  // namespace lather::testing_support
