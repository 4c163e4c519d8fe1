// Points that are held or driven: they keep to their paths whatever forces and walls say, and let go in time.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/plan/plan.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

constexpr double kSpacing = 0.05;
constexpr double kMiddleX = 0.5;  // of the block

/// A block of 8 x 4 (x 4) points of jelly around (0.5, 0.5, 0), under gravity; `grips` is the list's JSON.
std::string block(int dimension, const std::string& grips) {
  return R"({"lather": 1, "name": "block", "solver": "mlsrk", "dimension": )" + std::to_string(dimension) +
         R"(, "domain": {"min": [0, 0, -0.4], "max": [1, 1, 0.4]}, "duration": 0.2, "frame_rate": 20,
    "spacing": 0.05, "jitter": 0.2, "seed": 3,
    "materials": [{"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 5e4,
                   "poisson_ratio": 0.3}],
    "bodies": [{"name": "block", "material": "jelly",
                "shape": {"type": "box", "size": [0.4, 0.2, 0.2], "translate": [0.5, 0.5, 0]}}],
    "obstacles": [{"name": "post", "shape": {"type": "sphere", "radius": 0.1, "translate": [0.5, 0.5, 0]}}],
    "grips": )" +
         grips + "}";
}

struct Point {
  Vec3 x;
  Vec3 v;
};
using Points = std::map<std::uint32_t, Point>;  // by id

/// All points at the frames 0 … last.
std::vector<Points> states(const std::string& scene_json, const std::vector<Override>& overrides = {}) {
  const Scene scene = parse_scene(scene_json, "", overrides);
  const auto simulation = Simulation::create(make_plan(scene), 1);
  std::vector<Points> out;
  for (int i = 0; i <= scene.last_frame(); ++i) {
    simulation->step_to_frame(i, [](const Progress&) { return true; });
    Points points;
    simulation->visit_points([&](const PointState& p) { points[p.id] = {p.position, p.velocity}; });
    out.push_back(points);
  }
  return out;
}

/// The right half of the block, held.
const char* const kRightHalf =
    R"([{"name": "hand", "body": "block", "shape": {"type": "box", "size": [0.2, 1, 1], "translate": [0.6, 0.5, 0]}}])";

/// All of it, turned once about z in 0.2 s.
const char* const kTurning =
    R"([{"name": "hand", "body": "block", "motion": {"type": "rotation", "center": [0.4, 0.45, 0], "axis": [0, 0, 1],
        "rate_deg": 1800}}])";

class MlsrkGrips : public testing::TestWithParam<int> {};

TEST_P(MlsrkGrips, AHeldPointStaysToTheBitWhileOthersSag) {
  for (const char* precision : {"float", "double"}) {
    const auto seen = states(block(GetParam(), kRightHalf), {{"/numerics/precision", precision}});
    double deepest = 0;
    for (const auto& [id, last] : seen.back()) {
      const Point& first = seen.front().at(id);
      if (first.x.x() > kMiddleX) {
        EXPECT_EQ(last.x, first.x);
        EXPECT_EQ(last.v, Vec3(Vec3::Zero()));
      } else {
        deepest = std::max(deepest, first.x.y() - last.x.y());
      }
    }
    EXPECT_GT(deepest, 0.2 * kSpacing);
  }
}

// A step lands on the path itself, so that only rounding of positions is left: steps of at most 0.2 spacings
// hold 2^-24 of their length each in single precision, and a quantum of 2^-30 cells; both grow like the
// square root of the 150 steps or so.
TEST_P(MlsrkGrips, ADrivenBodyIsOnItsPathAtEveryFrameAndBackAfterATurn) {
  for (const auto& [precision, tolerance] :
       {std::pair{"float", 1e-6 * kSpacing}, std::pair{"double", 1e-13 * kSpacing}}) {
    const auto seen = states(block(GetParam(), kTurning), {{"/numerics/precision", precision}});
    ASSERT_EQ(seen.size(), 5U);
    const Vec3 center(0.4, 0.45, 0);
    for (std::size_t frame = 1; frame < seen.size(); ++frame) {
      const Mat3 turn(Eigen::AngleAxisd(M_PI / 2 * static_cast<double>(frame), Vec3::UnitZ()));
      for (const auto& [id, now] : seen[frame]) {
        const Vec3 x = center + turn * (seen.front().at(id).x - center);
        EXPECT_LT((now.x - x).norm(), tolerance) << precision << ' ' << frame;
        // The mean velocity of a step: shorter than that at its end by (angle of a step)^2 / 24, and half an
        // angle behind.
        const Vec3 v = 10 * M_PI * Vec3::UnitZ().cross(x - center);
        EXPECT_LT((now.v - v).norm(), 0.05 * v.norm()) << precision << ' ' << frame;
      }
    }
  }
}

// A step starts at most at the time of release or after it, and frames are steps' ends: from the frame at 0.1
// s on the body falls, a free fall to rounding where nothing is in its way.
TEST_P(MlsrkGrips, ItsPointsAreLetGoAtItsEnd) {
  const Report r = run(block(GetParam(), R"([{"name": "hand", "body": "block", "end": 0.1}])"),
                       {{"/obstacles", "[]"}, {"/numerics/precision", "double"}});
  for (const FrameMeasure& f : r.frames)
    EXPECT_NEAR(f.momentum.y() / f.mass, -9.81 * std::max(0.0, f.time - 0.1), 1e-6) << f.time;
}

// It falls until 0.1 s and is carried to the right from where it then is.
TEST_P(MlsrkGrips, ItsPointsAreFreeUntilItStartsAndTakenFromWhereTheyAre) {
  const auto seen =
      states(block(GetParam(), R"([{"name": "hand", "shape": {"type": "plane", "translate": [0, 2, 0]},
                                    "start": 0.1, "motion": {"type": "linear", "velocity": [1, 0, 0]}}])"),
             {{"/obstacles", "[]"}, {"/numerics/precision", "double"}});
  for (const auto& [id, last] : seen[4]) {
    const Vec3 caught = seen[2].at(id).x;
    EXPECT_NEAR(caught.y() - seen[0].at(id).x.y(), -9.81 * 0.01 / 2, 0.05 * 0.05);
    EXPECT_LT((last.x - caught - Vec3(0.1, 0, 0)).norm(), 1e-12);
  }
}

// Nothing moves before 0.1 s, when points are taken along at 40 m/s: 2 spacings in a step of waves alone.
TEST_P(MlsrkGrips, AnAutomaticStepIsShortEnoughForAGripThatSetsIn) {
  const Report r = run(block(GetParam(), R"([{"name": "hand", "body": "block", "motion":
                          {"type": "linear", "velocity": [40, 0, 0], "start": 0.1, "end": 0.105}}])"),
                       {{"/gravity", "[0, 0, 0]"}, {"/obstacles", "[]"}});
  EXPECT_LE(r.largest_cfl, 0.2 * 1.001);
  EXPECT_GT(r.largest_cfl, 0.15);
}

TEST_P(MlsrkGrips, RunsAreBitEqualForAnyNumberOfThreadsAndAfterARestore) {
  const std::string turned = R"([{"name": "hand", "body": "block", "start": 0.02, "end": 0.17,
    "shape": {"type": "box", "size": [0.2, 1, 1], "translate": [0.6, 0.5, 0]},
    "motion": {"type": "rotation", "center": [0.4, 0.45, 0], "axis": [0, 0, 1], "rate_deg": 300}}])";
  const Report one = run(block(GetParam(), turned), {}, 1);
  const Report three = run(block(GetParam(), turned), {}, 3);
  for (std::size_t i = 0; i < one.frames.size(); ++i)
    EXPECT_EQ(one.frames[i].fingerprint, three.frames[i].fingerprint);
  testing_support::expect_bit_equal_after_restore(make_plan(parse_scene(block(GetParam(), turned))), 1, 3);
}

TEST_P(MlsrkGrips, OneThatTakesPointsOutOfTheDomainEndsTheRunUnlessItIsOpen) {
  // The block's face at x = 0.7 reaches the domain's at 1 after 0.15 s.
  const std::string scene =
      block(GetParam(),
            R"([{"name": "hand", "body": "block", "motion": {"type": "linear", "velocity": [2, 0, 0]}}])");
  try {
    (void)run(scene);
    ADD_FAILURE() << "The run went on.";
  } catch (const SimulationError& error) {
    EXPECT_EQ(error.details().kind, "grip");
    EXPECT_NEAR(error.details().time, 0.15,
                0.02);  // jitter moves points by up to a fifth of the spacing, 0.005 s
  }
  EXPECT_GT(run(scene, {{"/domain/boundary", "open"}}).frames.back().points_left, 0U);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, MlsrkGrips, testing::Values(2, 3),
                         [](const auto& c) { return std::to_string(c.param) + "D"; });

}  // namespace
}  // namespace lather
