// The blend of velocities steadies a jelly that drops [MLSRK Figure 4], 1,156 points: the paper's size.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// How far volumes of single points stray, (max J - min J) averaged over the frames after the first impact at
/// 0.25 s: of the body as a whole the volume changes by a few per cent.
double noise(const char* blend) {
  const Report r = run_scene(scene_file("jelly-drop-2d", "preview",
                                        {{"/numerics/mlsrk/velocity_blend", blend}, {"/duration", "0.75"}}),
                             1);
  double sum = 0;
  int frames = 0;
  for (const FrameMeasure& f : r.frames) {
    if (f.time < 0.3) continue;
    sum += f.max_volume_ratio - f.min_volume_ratio;
    ++frames;
  }
  return sum / frames;
}

TEST(JellyDrop, IsNoisyWithoutTheBlendAndCalmWithIt) {
  const double none = noise("1");
  const double weak = noise("0.95");
  const double strong = noise("0.8");
  std::printf("  spread of J: %.3f without, %.3f at 0.95, %.3f at 0.8\n", none, weak, strong);
  EXPECT_GT(none, 1.5 * weak);
  EXPECT_GT(weak, strong);
  EXPECT_LT(strong, 0.25);
}

}  // namespace
}  // namespace lather::testing_support
