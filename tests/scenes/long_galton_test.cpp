// The Galton board [MLSRK Figure 6] at the paper's size: 1,876 points at 10 mm. Without the correction steps
// are the paper's, 1e-4 s.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/scenes/galton.h"

namespace lather::testing_support {
namespace {

TEST(GaltonBoard, KeepsTheWatersAreaWithTheVolumeCorrectionAndNotWithout) {
  const double corrected = area_kept("paper", {}, 0);
  const double drifting = area_kept(
      "paper", {{"/numerics/mlsrk/volume_correction", "false"}, {"/numerics/time_step", "1e-4"}}, 0);
  std::printf("  area at rest over that at the start: %.4f with the correction, %.4f without\n", corrected,
              drifting);
  EXPECT_NEAR(corrected, 1, 0.02);
  EXPECT_GT(std::abs(drifting - 1), 0.05);
}

}  // namespace
}  // namespace lather::testing_support
