// The pulled dollop [Foam Figures 7 and 8]: with tearing the neck breaks, without it stays.

#include "tests/scenes/dollop.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(PulledDollop, BreaksWhereItTearsSoonerIfBrittleAndStaysConnectedWithoutTearing) {
  // At a few cells' width when and where a neck breaks depends on where its points happen to lie: of five
  // samples of points the brittle ones part at 0.317 s in the mean, with a standard deviation of 0.035 s, the
  // sticky ones at 0.377 s and 0.020 s. Means over three are told apart by 2.5 deviations of their
  // difference.
  std::vector<std::vector<Override>> samples;
  for (const char* seed : {"1", "2", "3"}) samples.push_back({{"/jitter", "0.3"}, {"/seed", seed}});
  expect_tearing_parts_what_else_stays_connected("preview", 1, samples);
}

}  // namespace
}  // namespace lather::testing_support
