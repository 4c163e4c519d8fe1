// The sheared blob [Foam Figure 6] at half the preview's spacing and less: 5,524 points, 2 mm, all of the
// scene.

#include <gtest/gtest.h>

#include "tests/scenes/sheared_blob.h"

namespace lather::testing_support {
namespace {

TEST(ShearedBlob, HasInteriorVoidsOnlyWithoutResamplingAndKeepsItsMass) {
  expect_voids_only_without_resampling("paper", 0);
}

}  // namespace
}  // namespace lather::testing_support
