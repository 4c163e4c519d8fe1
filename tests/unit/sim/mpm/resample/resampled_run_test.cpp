// Whole runs with resampling: no voids, mass, momentum, and the same answer every time.

#include <gtest/gtest.h>

#include <set>

#include "tests/support/kernel_levels.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// A column of foam pressed flat between smooth plates; 2D, or 3D and periodic in z.
std::string pressed_column(int dimension) {
  return std::string(
             R"({"lather": 1, "domain": {"min": [-0.16, -0.12, -0.02], "max": [0.16, 0.12, 0.02], "periodic": [false, false, )") +
         (dimension == 3 ? "true" : "false") + R"(]}, "dimension": )" + std::to_string(dimension) + R"(,
    "gravity": [0, 0, 0], "duration": 0.095, "frame_rate": 200, "spacing": 0.005,
    "materials": [{"name": "foam", "preset": "shaving-cream"}],
    "bodies": [{"name": "blob", "material": "foam", "shape": {"type": "box", "size": [0.044, 0.16, 0.1]}}],
    "obstacles": [
      {"name": "upper", "shape": {"type": "box", "size": [0.4, 0.04, 0.4], "translate": [0, 0.102, 0]},
       "motion": {"type": "linear", "velocity": [0, -0.66, 0]}},
      {"name": "lower", "shape": {"type": "box", "size": [0.4, 0.04, 0.4], "translate": [0, -0.102, 0]},
       "motion": {"type": "linear", "velocity": [0, 0.66, 0]}}],
    "numerics": {"transfer": "apic", "resampling": {"interval": 5e-4}}})";
}

std::int64_t most_voids(const Report& r) {
  std::int64_t most = 0;
  for (const FrameMeasure& m : r.frames) most = std::max(most, m.interior_voids);
  return most;
}

TEST(ResampledRun, HasNoVoidsWhereOneWithoutHas) {
  const Report with = run(pressed_column(2), {});
  const Report without = run(pressed_column(2), {{"/numerics/resampling", "null"}});
  EXPECT_EQ(most_voids(with), 0);
  EXPECT_GT(most_voids(without), 10);
  EXPECT_GT(with.frames.back().points_inserted, 100U);
  // Shares add up exactly; what differs is the rounding of a sum over a few thousand points.
  const double mass = with.frames.front().mass;
  EXPECT_NEAR(with.frames.back().mass, mass, 1e-12 * mass);
  // Momentum: float's rounding of each new point's velocity, against mass times plate speed.
  EXPECT_LT(with.frames.back().resampling_momentum, 1e-6 * mass * 0.66);
}

TEST(ResampledRun, InterpolatedVelocitiesDoNotConserveMomentum) {
  const std::vector<Override> shorter = {{"/duration", "0.06"}};
  std::vector<Override> interpolated = shorter;
  interpolated.push_back({"/numerics/resampling/velocity", "interpolated"});
  const double conserving = run(pressed_column(2), shorter).frames.back().resampling_momentum;
  EXPECT_GT(run(pressed_column(2), interpolated).frames.back().resampling_momentum, 1000 * conserving);
}

TEST(ResampledRun, IsBitEqualForAnyNumberOfThreads) {
  for (const int dimension : {2, 3}) {
    // The column is stretched already, so that points are inserted from the start.
    const std::vector<Override> set = {{"/duration", dimension == 2 ? "0.03" : "0.005"}, {"/jitter", "0.5"}};
    const Report one = run(pressed_column(dimension), set, 1);
    ASSERT_GT(one.frames.back().points_inserted, 50U);
    for (const int threads : {2, 3, 8}) {
      const Report many = run(pressed_column(dimension), set, threads);
      for (std::size_t f = 0; f < one.frames.size(); ++f) {
        EXPECT_EQ(many.frames[f].fingerprint, one.frames[f].fingerprint) << dimension << "D, " << threads;
        EXPECT_EQ(many.frames[f].points_inserted, one.frames[f].points_inserted);
      }
    }
  }
}

// A resampling comes every ten steps or so: some checkpoints are made right after one, before the next sort.
TEST(ResampledRun, GoesOnBitEqualFromACheckpointBetweenTwoResamplings) {
  testing_support::expect_bit_equal_after_restore(
      make_plan(parse_scene(pressed_column(2), "", {{"/duration", "0.025"}, {"/jitter", "0.5"}})), 3, 12);
}

TEST(ResampledRun, KeepsIdsUniqueAndNeverUsesOneAgain) {
  const Scene scene = parse_scene(pressed_column(2), "", {{"/duration", "0.05"}, {"/jitter", "0.5"}});
  const auto simulation = Simulation::create(make_plan(scene), 1);
  std::set<std::uint32_t> gone;
  std::set<std::uint32_t> before;
  for (int i = 0; i <= scene.last_frame(); ++i) {
    simulation->step_to_frame(i, [](const Progress&) { return true; });
    const Frame frame = simulation->frame();
    const std::set<std::uint32_t> now(frame.points.id.begin(), frame.points.id.end());
    EXPECT_EQ(now.size(), frame.points.size());
    for (const std::uint32_t id : before)
      if (now.count(id) == 0) gone.insert(id);
    for (const std::uint32_t id : gone) EXPECT_EQ(now.count(id), 0U);
    before = now;
  }
}

TEST(ResampledRun, PlansItsFieldAndStageAndOthersDoNot) {
  const auto has = [](const Plan& p) {
    int found = 0;
    for (const std::string& s : p.stages) found += s == "avoid a void" ? 1 : 0;
    for (const PlannedField& f : p.materials[0].fields) found += f.name == "share of mass" ? 1 : 0;
    return found;
  };
  EXPECT_EQ(has(make_plan(parse_scene(pressed_column(2)))), 2);
  EXPECT_EQ(has(make_plan(parse_scene(pressed_column(2), "", {{"/numerics/resampling", "null"}}))), 0);
}

}  // namespace
}  // namespace lather
