// Water falls through a Galton board [MLSRK Figure 6] at preview: 468 points at 20 mm.

#include "tests/scenes/galton.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace lather::testing_support {
namespace {

// Volumes that are added up step by step drift as points are torn apart and put together again; the
// correction takes them from the points' places.
TEST(GaltonBoard, KeepsTheWatersAreaWithTheVolumeCorrectionAndNotWithout) {
  const double corrected = area_kept("preview", {}, 1);
  const double drifting = area_kept(
      "preview", {{"/numerics/mlsrk/volume_correction", "false"}, {"/numerics/time_step", "2e-4"}}, 1);
  std::printf("  area at rest over that at the start: %.4f with the correction, %.4f without\n", corrected,
              drifting);
  EXPECT_NEAR(corrected, 1, 0.02);
  EXPECT_GT(std::abs(drifting - 1), 0.05);
}

}  // namespace
}  // namespace lather::testing_support
