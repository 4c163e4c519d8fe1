// The thrown pie [Foam Figure 12]: it splats, tears, and most of it sticks to the face.

#include "tests/scenes/pie.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(PieThrow, SticksToTheFaceAndNothingFloats) {
  expect_cream_sticks_to_the_face("preview", {{"/duration", "1"}}, 1);
}

}  // namespace
}  // namespace lather::testing_support
