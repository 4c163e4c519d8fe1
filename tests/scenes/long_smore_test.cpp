// The uniform s'more [Foam Figure 10] at the paper's size: 206,844 points, 1.6 mm, the card's moduli, all of
// it. Steps are those that the plan chooses at half its bound, 17 us in place of the paper's 10.

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"
#include "tests/scenes/smore.h"

namespace lather::testing_support {
namespace {

TEST(Smore, RisesThroughTheHolesAndKeepsAPeak) {
  expect_foam_through_holes_and_a_peak(
      scene_file("smore", "paper", {{"/numerics/time_step", "0"}, {"/numerics/safety_factor", "0.5"}}), 0);
}

}  // namespace
}  // namespace lather::testing_support
