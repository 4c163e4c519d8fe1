// The pulled dollop [Foam Figures 7 and 8] at the paper's size: 57,508 points, 3 mm, the card's moduli. Steps
// are those that the plan chooses at 0.5 of its bound, 40 us in place of the paper's 10; the blend is defined
// per time. Pulls end 0.03 s after the parts have separated; the run with removal goes on to the scene's end.

#include <gtest/gtest.h>

#include "tests/scenes/dollop.h"

namespace lather::testing_support {
namespace {

const std::vector<Override> kPlannedSteps = {{"/numerics/time_step", "0"},
                                             {"/numerics/safety_factor", "0.5"}};

TEST(PulledDollop, BreaksWhereItTearsSoonerIfBrittleAndStaysConnectedWithoutTearing) {
  expect_tearing_parts_what_else_stays_connected("paper", 0, {kPlannedSteps});
}

TEST(PulledDollop, LosesLittleMassToSubgridRemoval) {
  expect_removal_takes_little("paper", 0, kPlannedSteps);
}

}  // namespace
}  // namespace lather::testing_support
