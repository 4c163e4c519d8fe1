// Drops of foam fall on a scale: what came in is what the scale weighs.

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

TEST(DropOnScale, TheScaleReadsTheWeightOfTheDropsThatCameIn) {
  const Report r = run_scene(scene_file("drop-on-scale", "preview"), 1);
  ASSERT_EQ(r.probes.front().name, "scale");
  const ProbeSeries& scale = r.probes.front();
  double force = 0;
  double samples = 0;
  for (std::size_t i = 0; i < scale.times.size(); ++i)
    if (scale.times[i] > 1.05) {
      force += scale.values[i * scale.columns.size() + 1];
      ++samples;
    }
  // The fourth drop landed at 0.9 s. A mean over 0.15 s differs from the weight by the change of velocity in
  // it over 0.15 g: 1 % for 1.5 cm/s.
  const double weight = 9.81 * r.frames.back().mass;
  EXPECT_NEAR(force / samples, -weight, 0.01 * weight);
  // The mass of a point is single precision's.
  EXPECT_NEAR(r.frames.back().mass, r.frames.back().mass_emitted, 6e-8 * r.frames.back().mass);
  EXPECT_EQ(r.frames.back().mass_left, 0);
}

}  // namespace
}  // namespace lather::testing_support
