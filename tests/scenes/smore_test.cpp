// The s'mores [Foam Figures 10 and 11].

#include "tests/scenes/smore.h"

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

TEST(Smore, RisesThroughTheHolesAndKeepsAPeak) {
  expect_foam_through_holes_and_a_peak(scene_file("smore", "preview"), 1);
}

// A quarter of a second: the press ends at 0.22 s, and what it shows has been seen.
TEST(ToastedSmore, TearsItsShellBeforeTheCoreFlowsOut) {
  expect_crust_tears_before_core_flows(scene_file("smore-toasted", "preview", {{"/duration", "0.25"}}), 1);
}

}  // namespace
}  // namespace lather::testing_support
