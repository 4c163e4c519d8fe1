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

}  // namespace
}  // namespace lather::testing_support
