// The falling block [MLSRK Figure 9], 250 points: at the paper's size in both sizes of the scene.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// The block's velocity over that of a free fall in the last frame before it lands: its lowest points fall
/// 0.75 m, in 0.39 s.
double share_of_free_fall(const Scene& scene) {
  const Report r = run_scene(scene, 1);
  double share = 0;
  for (const FrameMeasure& f : r.frames)
    if (f.time > 0.1 && f.time < 0.35) share = f.momentum.y() / f.mass / (scene.gravity.y() * f.time);
  return share;
}

TEST(FallingBlock, FallsWithGravityWhereConstantsAreReproduced) {
  EXPECT_NEAR(share_of_free_fall(scene_file("falling-block", "preview", {{"/duration", "0.4"}})), 1, 1e-6);
}

TEST(FallingBlock, FloatsWhereTheyAreNot) {
  const Scene scene = scene_file("falling-block", "preview",
                                 {{"/duration", "0.4"}, {"/numerics/mlsrk/regularize_constant", "true"}});
  EXPECT_LT(share_of_free_fall(scene), 0.99);
}

// The scene's solver changes by one word.
TEST(FallingBlock, FallsAsFreelyOnAGrid) {
  EXPECT_NEAR(
      share_of_free_fall(scene_file("falling-block", "preview", {{"/duration", "0.4"}, {"/solver", "mpm"}})),
      1, 1e-6);
}

TEST(FallingBlock, BouncesAndComesBackToItsShape) {
  const Report r = run_scene(scene_file("falling-block", "preview"), 1);
  double least = 1;
  double highest_after = 0;
  for (const FrameMeasure& f : r.frames) {
    least = std::min(least, f.min_volume_ratio);
    if (f.time > 0.55) highest_after = std::max(highest_after, f.center_of_mass.y());
    EXPECT_EQ(f.pieces, 1U);
  }
  EXPECT_LT(least, 0.95);          // it is squeezed on the ground
  EXPECT_GT(highest_after, 0.35);  // a block that stands has its centre at 0.25 m
  EXPECT_GT(r.frames.back().lowest.y(), -0.05);
}

}  // namespace
}  // namespace lather::testing_support
