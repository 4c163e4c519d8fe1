// The pulled dollop [Foam Figures 7 and 8] at the paper's size: 57,508 points, 3 mm, steps of 1e-5 s, the
// card's moduli. Pulls end 0.03 s after the parts have separated; the run with removal goes on to the scene's
// end.

#include <gtest/gtest.h>

#include "tests/scenes/dollop.h"

namespace lather::testing_support {
namespace {

TEST(PulledDollop, BreaksWhereItTearsSoonerIfBrittleAndStaysConnectedWithoutTearing) {
  expect_tearing_parts_what_else_stays_connected("paper", 0);
}

TEST(PulledDollop, LosesLittleMassToSubgridRemoval) {
  expect_removal_takes_little("paper", 0);
}

}  // namespace
}  // namespace lather::testing_support
