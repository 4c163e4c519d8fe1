// The sheared blob [Foam Figure 6]: voids without resampling, none with it.

#include "tests/scenes/sheared_blob.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(ShearedBlob, HasInteriorVoidsOnlyWithoutResamplingAndKeepsItsMass) {
  expect_voids_only_without_resampling("preview", 1);
}

}  // namespace
}  // namespace lather::testing_support
