// Tearing in whole runs: a neck breaks, what is torn is reported, results stay reproducible.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/kernel_levels.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

/// A bar with a notch between two adhesive holders that draw it out, 2D.
std::string bar_scene() {
  return R"({"lather": 1, "name": "bar", "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [-0.4, -0.1], "max": [0.4, 0.1], "boundary": "open"},
    "duration": 0.24, "frame_rate": 50, "spacing": 0.01,
    "materials": [{"name": "foam", "preset": "shaving-cream", "tear_threshold": 2, "recovery_time": "infinity"}],
    "bodies": [{"name": "bar", "material": "foam", "shape": {"type": "difference", "of": [
      {"type": "box", "size": [0.3, 0.06]},
      {"type": "sphere", "radius": 0.015, "translate": [0, 0.035]},
      {"type": "sphere", "radius": 0.015, "translate": [0, -0.035]}]}}],
    "obstacles": [
      {"name": "left", "shape": {"type": "box", "size": [0.1, 0.1], "translate": [-0.15, 0]}, "adhesive": true,
       "motion": {"type": "linear", "velocity": [-0.5, 0]}},
      {"name": "right", "shape": {"type": "box", "size": [0.1, 0.1], "translate": [0.15, 0]}, "adhesive": true,
       "motion": {"type": "linear", "velocity": [0.5, 0]}}]})";
}

struct Outcome {
  double gap;            ///< widest stretch of x without points, cells
  double weak_fraction;  ///< of the last frame
};

Outcome stretch(const std::vector<Override>& overrides) {
  const Scene scene = parse_scene(bar_scene(), "", overrides);
  const auto simulation = Simulation::create(make_plan(scene), 1);
  std::vector<float> x;
  for (int i = 0; i <= scene.last_frame(); ++i) {
    simulation->step_to_frame(i, [](const Progress&) { return true; });
    x.clear();
    for (const auto& p : simulation->frame().points.position) x.push_back(p[0]);
    std::sort(x.begin(), x.end());
  }
  double widest = 0;
  for (std::size_t i = 1; i < x.size(); ++i)
    widest = std::max(widest, static_cast<double>(x[i]) - static_cast<double>(x[i - 1]));
  return {widest / scene.spacing, simulation->report().frames.back().weak_fraction};
}

TEST(TearingRun, ADrawnBarBreaksWhereTheSameWithoutTearingStaysOnePiece) {
  const Outcome whole = stretch({{"/materials/0/tear_threshold", "infinity"}});
  const Outcome torn = stretch({});
  // Points further apart than twice the kernel's reach of two cells share no node.
  EXPECT_LT(whole.gap, 3);
  EXPECT_EQ(whole.weak_fraction, 0);
  EXPECT_GT(torn.gap, 4);
  EXPECT_GT(torn.weak_fraction, 0.01);
  EXPECT_LT(torn.weak_fraction, 0.9);
}

/// A ball that is weak all over and one that never is fall on ground beside each other.
std::string busy_scene(const char* precision, int dimension) {
  const bool plane = dimension == 2;
  return std::string(R"({"lather": 1, "name": "busy", "dimension": )") + std::to_string(dimension) +
         R"(, "domain": )" +
         (plane ? R"({"min": [-0.3, 0], "max": [0.3, 0.4]})"
                : R"({"min": [-0.3, 0, -0.2], "max": [0.3, 0.4, 0.2]})") +
         R"(, "duration": 0.06, "frame_rate": 50, "spacing": 0.025, "jitter": 0.3, "seed": 3, "materials": [
    {"name": "weak", "preset": "shaving-cream", "tear_threshold": 0.1, "recovery_time": 0.35},
    {"name": "whole", "preset": "oobleck", "tear_threshold": "infinity"}],
    "bodies": [
    {"name": "a", "material": "weak", "velocity": )" +
         (plane ? "[0.5, -3]" : "[0.5, -3, 0.3]") +
         R"(, "shape": {"type": "sphere", "radius": 0.07, "translate": )" +
         (plane ? "[-0.1, 0.12]" : "[-0.1, 0.12, 0]") + R"(}},
    {"name": "b", "material": "whole", "velocity": )" +
         (plane ? "[-0.5, -2]" : "[-0.5, -2, 0]") +
         R"(, "shape": {"type": "sphere", "radius": 0.05, "translate": )" +
         (plane ? "[0.1, 0.12]" : "[0.1, 0.12, 0]") +
         R"(}}],
    "obstacles": [{"name": "ground", "friction": 0.4, "shape": {"type": "plane", "translate": )" +
         (plane ? "[0, 0.05]" : "[0, 0.05, 0]") + R"(}}],
    "numerics": {"precision": ")" +
         precision + R"("}})";
}

class TearingRuns : public testing::TestWithParam<KernelLevel> {};

TEST_P(TearingRuns, AreBitEqualForAnyNumberOfThreads) {
  for (const int dimension : {2, 3})
    for (const char* precision : {"float", "double"}) {
      const Report one = testing_support::run(busy_scene(precision, dimension), {}, 1, GetParam());
      const Report many = testing_support::run(busy_scene(precision, dimension), {}, 3, GetParam());
      ASSERT_GT(one.frames.back().weak_fraction, 0.05);
      ASSERT_LT(one.frames.back().weak_fraction, 0.95);
      ASSERT_EQ(one.frames.size(), many.frames.size());
      for (std::size_t f = 0; f < one.frames.size(); ++f) {
        EXPECT_EQ(many.frames[f].fingerprint, one.frames[f].fingerprint);
        EXPECT_EQ(many.frames[f].weak_fraction, one.frames[f].weak_fraction);
      }
    }
}

TEST_P(TearingRuns, GoOnBitEqualAfterARestoreBetweenTwoRecoveries) {
  // Recovery acts every thousandth of its time; here every 40 steps or so, and the run stops in between.
  const Plan plan = make_plan(parse_scene(busy_scene("float", 3), "", {{"/materials/0/recovery_time", "10"}}),
                              {GetParam()});
  const auto go_on = [](const Progress&) { return true; };
  const auto whole = Simulation::create(plan, 2);
  whole->step_to_frame(1, go_on);
  int left = 7;
  EXPECT_FALSE(whole->step_to_frame(2, [&](const Progress&) { return --left > 0; }));
  const std::string saved = whole->save();
  whole->step_to_frame(3, go_on);
  const auto resumed = Simulation::create(plan, 1);
  resumed->restore(saved);
  resumed->step_to_frame(3, go_on);
  ASSERT_GT(whole->report().frames.back().weak_fraction, 0.05);
  ASSERT_EQ(resumed->report().frames.size(), whole->report().frames.size());
  for (std::size_t f = 0; f < whole->report().frames.size(); ++f) {
    EXPECT_EQ(resumed->report().frames[f].fingerprint, whole->report().frames[f].fingerprint);
    EXPECT_EQ(resumed->report().frames[f].weak_fraction, whole->report().frames[f].weak_fraction);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, TearingRuns, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

TEST(TearingRun, FramesShowPlasticityAndWhatIsWeak) {
  const auto values = [](const char* scalar) {
    const Scene scene = parse_scene(busy_scene("float", 2), "", {{"/look/color_by", scalar}});
    const auto simulation = Simulation::create(make_plan(scene), 1);
    simulation->step_to_frame(3, [](const Progress&) { return true; });
    return std::pair(simulation->frame(), simulation->report().frames.back().weak_fraction);
  };
  const auto [by_plasticity, fraction] = values("plasticity");
  const Frame by_weakness = values("weak").first;
  const std::vector<float>& plasticity = by_plasticity.points.scalars.at(0).values;
  const std::vector<float>& weak = by_weakness.points.scalars.at(0).values;
  ASSERT_EQ(plasticity.size(), weak.size());
  for (std::size_t i = 0; i < weak.size(); ++i) {
    const bool may_tear = by_weakness.points.material[i] == 0;
    EXPECT_EQ(weak[i], may_tear && plasticity[i] > 0.1F ? 1 : 0);
  }
  const auto count = static_cast<double>(std::count(weak.begin(), weak.end(), 1.0F));
  EXPECT_GT(count, 0);
  EXPECT_DOUBLE_EQ(count / static_cast<double>(weak.size()), fraction);
}

}  // namespace
}  // namespace lather
