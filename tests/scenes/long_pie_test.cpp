// The thrown pie [Foam Figure 12] at the paper's size: 676,100 points, 1.6 mm, the card's moduli, the first
// second. Steps are those that the plan chooses at 0.5 of its bound, 40 us in place of the paper's 10, or it
// would not end within an hour.

#include <gtest/gtest.h>

#include "tests/scenes/pie.h"

namespace lather::testing_support {
namespace {

TEST(PieThrow, SticksToTheFaceAndNothingFloats) {
  expect_cream_sticks_to_the_face(
      "paper", {{"/numerics/time_step", "0"}, {"/numerics/safety_factor", "0.5"}, {"/duration", "1"}}, 0);
}

}  // namespace
}  // namespace lather::testing_support
