// The spinning top [MLSRK Figure 10] at preview: one turn takes 0.1 s.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// The share of its angular momentum about the vertical that is left after one turn in the air.
double kept(const char* regularization) {
  const Report r =
      run_scene(scene_file("spinning-top", "preview",
                           {{"/duration", "0.1"}, {"/numerics/mlsrk/regularization", regularization}}),
                1);
  return r.frames.back().angular_momentum.y() / r.frames.front().angular_momentum.y();
}

// Gradients of a rotation are off by about r over the moments, which are of order 1/3: what a blend of
// velocities then takes grows with r, up to that of Shepard's functions (r = 1e6).
TEST(SpinningTop, KeepsItsSpinTheBetterTheSmallerTheRegularizationIs) {
  const double finest = kept("1e-4");
  const double fine = kept("1e-2");
  const double coarse = kept("1");
  const double shepard = kept("1e6");
  std::printf("  angular momentum left: %.4f, %.4f, %.4f, Shepard %.4f\n", finest, fine, coarse, shepard);
  EXPECT_GT(finest, 0.99);
  EXPECT_GT(finest, fine);
  EXPECT_GT(fine, coarse);
  EXPECT_GT(coarse, shepard);
  EXPECT_LT(coarse, 0.5);
}

}  // namespace
}  // namespace lather::testing_support
