// The pulled dollop [Foam Figures 7 and 8]: with tearing the neck breaks, without it stays.

#include "tests/scenes/dollop.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(PulledDollop, BreaksWhereItTearsSoonerIfBrittleAndStaysConnectedWithoutTearing) {
  expect_tearing_parts_what_else_stays_connected("preview", 1);
}

}  // namespace
}  // namespace lather::testing_support
