// What walls and obstacles are to the volumes of the points beside them [MLSRK eq. 19].

#include <gtest/gtest.h>

#include "sim/plan/plan.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// Water that fills the space between planes.
std::string closed_box(int dimension) {
  std::string json = R"({"lather": 1, "name": "box", "solver": "mlsrk", "dimension": DIM,
    "domain": {"min": [-1, -1, -1], "max": [1, 1, 1], "boundary": "open"}, "gravity": [0, 0, 0],
    "duration": 0.02, "frame_rate": 50, "spacing": 0.05,
    "materials": [{"name": "water", "model": "liquid", "density": 1000, "bulk_modulus": 1e5}],
    "bodies": [{"name": "water", "material": "water", "shape": {"type": "box", "size": [0.4, 0.3, 0.4],
                "translate": [0, 0.05, 0]}}],
    "obstacles": [
      {"name": "left", "shape": {"type": "plane", "normal": [1, 0, 0], "translate": [-0.2, 0, 0]}},
      {"name": "right", "shape": {"type": "plane", "normal": [-1, 0, 0], "translate": [0.2, 0, 0]}},
      {"name": "bottom", "shape": {"type": "plane", "normal": [0, 1, 0], "translate": [0, -0.1, 0]}},
      {"name": "top", "shape": {"type": "plane", "normal": [0, -1, 0], "translate": [0, 0.2, 0]}}FACES],
    "numerics": {"precision": "double"}})";
  const auto put = [&json](const char* at, const std::string& text) {
    json.replace(json.find(at), std::string(at).size(), text);
  };
  put("DIM", std::to_string(dimension));
  put("FACES", dimension == 2 ? "" : R"(,
      {"name": "back", "shape": {"type": "plane", "normal": [0, 0, 1], "translate": [0, 0, -0.2]}},
      {"name": "front", "shape": {"type": "plane", "normal": [0, 0, -1], "translate": [0, 0, 0.2]}})");
  return json;
}

class Solids : public testing::TestWithParam<int> {};

// Rounding of some hundred kernels, and of what 1e5 Pa make of it in 5 steps.
TEST_P(Solids, AreFullBesideALatticeThatFillsTheSpaceBetweenThem) {
  for (const char* support : {"2", "2.5", "3"}) {
    const Report r = run(closed_box(GetParam()), {{"/numerics/mlsrk/support_radius", support}});
    const FrameMeasure& last = r.frames.back();
    EXPECT_NEAR(last.min_volume_ratio, 1, 1e-12) << support;
    EXPECT_NEAR(last.max_volume_ratio, 1, 1e-12) << support;
    EXPECT_LT(last.max_speed, 1e-12) << support;
  }
}

// Beside one plane it is full to rounding; in edges and corners the product of shares is above the lattice's
// by up to a third of a per cent, and nothing moves for it.
TEST_P(Solids, AreFullToARadialKernelButForCorners) {
  const Report r = run(closed_box(GetParam()), {{"/numerics/mlsrk/kernel_shape", "\"radial\""}});
  const FrameMeasure& last = r.frames.back();
  EXPECT_NEAR(last.min_volume_ratio, 1, 1e-12);
  EXPECT_NEAR(last.max_volume_ratio, 1, 0.005);
  EXPECT_LT(last.max_speed, 1e-12);
}

// The lid pulled off: a point at a free surface sees more space than its own.
TEST_P(Solids, AreNotWhereThereAreNone) {
  const Report r = run(closed_box(GetParam()), {{"/obstacles/3/shape/translate", "[0, 0.5, 0]"}});
  EXPECT_GT(r.frames.back().max_volume_ratio, 1.2);
}

// In free fall for 20 ms they would come 2 mm nearer; g dt^2 of one step of 2 ms is 0.04 mm.
TEST_P(Solids, StopPointsHalfASpacingBeforeThem) {
  const std::string box = R"({"min": [-0.2, -0.1, -0.2], "max": [0.2, 0.2, 0.2]})";
  const std::vector<std::vector<Override>> solids = {{}, {{"/obstacles", "[]"}, {"/domain", box}}};
  for (std::vector<Override> overrides : solids) {
    overrides.push_back({"/gravity", "[0, -9.81, 0]"});
    const Report r = run(closed_box(GetParam()), overrides);
    EXPECT_NEAR(r.frames.back().lowest.y(), -0.075, 5e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Solids, testing::Values(2, 3));

}  // namespace
}  // namespace lather
