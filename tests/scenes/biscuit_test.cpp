// A biscuit is dipped in water and pulled apart [MLSRK Figure 13] at preview: its section, 4 mm.

#include "tests/scenes/biscuit.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(Biscuit, FallsWhereItIsWetAndHoldsWhereItIsDry) {
  const BrokenBiscuit b = run_biscuit("preview", {}, 1);
  EXPECT_GT(b.wet, 0.2);
  EXPECT_GT(b.wet_fallen, 0.5);
  EXPECT_GT(b.dry_held, 0.9);
}

}  // namespace
}  // namespace lather::testing_support
