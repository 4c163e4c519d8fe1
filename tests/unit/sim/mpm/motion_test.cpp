// Points that move far less per step than a float can tell apart at their place.

#include <gtest/gtest.h>

#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// Travelled distance along x over the expected one, of a block at 0.7 m from the origin with steps of 1e-5 s
/// in float.
double travelled_share(double speed) {
  const std::string scene =
      R"({"lather": 1, "name": "creep", "domain": {"min": [0, 0, 0], "max": [1, 1, 1], "boundary": "open"},
    "gravity": [0, 0, 0], "duration": 0.02, "frame_rate": 50, "spacing": 0.003,
    "materials": [{"name": "foam", "preset": "shaving-cream"}],
    "bodies": [{"name": "block", "material": "foam", "velocity": [)" +
      std::to_string(speed) + R"(, 0, 0],
      "shape": {"type": "box", "size": [0.012, 0.012, 0.012], "translate": [0.7, 0.7, 0.7]}}],
    "numerics": {"time_step": 1e-5, "precision": "float"}})";
  const Report r = run(scene, {});
  EXPECT_EQ(r.steps, 2000U);
  return (r.frames.back().center_of_mass.x() - r.frames.front().center_of_mass.x()) / (speed * 0.02);
}

TEST(Motion, ABlockThatCreepsTravelsAsFarAsItShould) {
  EXPECT_NEAR(travelled_share(1e-3), 1, 0.01);
  EXPECT_NEAR(travelled_share(1e-6), 1, 0.01);
}

TEST(Motion, APointAtRestStaysBitForBit) {
  const Report r = run(testing_support::ball_scene(), {});
  EXPECT_EQ(r.frames.front().fingerprint, r.frames.back().fingerprint);
  EXPECT_GT(r.steps, 100U);
}

}  // namespace
}  // namespace lather
