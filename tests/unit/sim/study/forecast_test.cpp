// Trials: what they count and predict. How fast a machine is is nobody's to test.

#include "sim/study/forecast.h"

#include <gtest/gtest.h>

#include "sim/error.h"
#include "sim/simulation.h"
#include "tests/support/feature_scenes.h"

namespace lather::study {
namespace {

Scene block(const std::vector<Override>& overrides = {}) {
  return parse_scene(testing_support::feature_scenes().front().minimal, "", overrides);
}

TEST(Forecast, CountsPointsFromTheirReleaseOn) {
  const Plan still = make_plan(block());
  EXPECT_EQ(planned_point_steps(still), static_cast<double>(still.points * still.steps));
  // Two copies of the block, at a quarter and three quarters of the run: there for half of it on average.
  const Plan fed =
      make_plan(block({{"/emitters",
                        R"([{"name": "e", "material": "m", "start": 0.005, "interval": 0.01, "count": 2,
      "shape": {"type": "box", "size": [0.08, 0.08, 0.08], "translate": [0.16, 0.2, 0.16]}}])"}}));
  ASSERT_EQ(fed.points_emitted, 2 * still.points);
  EXPECT_NEAR(planned_point_steps(fed), static_cast<double>(fed.steps * 2 * still.points), 1e-6);
}

TEST(Forecast, OfATrialThatReachesTheEndIsTheWholeRun) {
  const Plan plan = make_plan(block());
  const Forecast forecast = study::forecast(plan, 1, 60);
  const auto simulation = Simulation::create(plan, 1);
  for (int i = 0; i < plan.frames; ++i) simulation->step_to_frame(i, [](const Progress&) { return true; });
  EXPECT_EQ(forecast.point_steps, static_cast<double>(simulation->report().point_steps));
  EXPECT_GT(forecast.cpu, 0);
  EXPECT_GT(forecast.wall, 0);
}

TEST(Forecast, GrowsWithTheDuration) {
  const Forecast one = forecast(make_plan(block()), 1, 0.01);
  const Forecast ten = forecast(make_plan(block({{"/duration", "0.2"}})), 1, 0.01);
  EXPECT_NEAR(ten.point_steps, 10 * one.point_steps, 1e-6 * ten.point_steps);
  EXPECT_GT(ten.cpu, one.cpu);
}

TEST(Forecast, TriesNoSceneThatIsTooLarge) {
  Plan plan = make_plan(block());
  plan.points = kMostTrialPoints + 1;
  EXPECT_THROW(static_cast<void>(forecast(plan, 1)), InputError);
}

}  // namespace
}  // namespace lather::study
