// Budgets, resolved: which quality is taken, what the plan keeps of it, and that it is chosen once.

#include "server/run/budget.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/error.h"
#include "sim/scene/quality.h"

namespace lather::server {
namespace {

Scene scene_with(const std::string& budget) {
  return parse_scene(
      R"({"lather": 1, "domain": {"min": [0, 0], "max": [1, 1]}, "dimension": 2, "duration": 0.1,
    "frame_rate": 100, "spacing": 0.05, "materials": [{"name": "m", "preset": "shaving-cream"}],
    "bodies": [{"name": "b", "material": "m",
                "shape": {"type": "box", "size": [0.5, 0.5, 1], "translate": [0.5, 0.5]}}],
    "numerics": {"max_time_step": 1e-3}, "budget": )" +
      budget + "}");
}

constexpr DrawingCost kFree = {0, 0};

/// The most accurate one, or the cheapest.
const QualityPoint& extreme_point(double QualityPoint::*of) {
  const auto& points = quality_points(Solver::kMpm);
  return *std::min_element(points.begin(), points.end(),
                           [&](const QualityPoint& a, const QualityPoint& b) { return a.*of < b.*of; });
}

TEST(BudgetPlan, OfMuchTimeTakesTheMostAccurateQuality) {
  const Plan plan = plan_in_budget(scene_with(R"({"seconds": 1e6})"), 1, kFree);
  ASSERT_TRUE(plan.choices.budget);
  EXPECT_EQ(plan.choices.budget->quality, extreme_point(&QualityPoint::error_factor).quality);
  EXPECT_GT(plan.choices.budget->seconds, 0);
  EXPECT_EQ(plan.choices.budget->error, extreme_point(&QualityPoint::error_factor).error);
  const Numerics wanted = numerics_of(Solver::kMpm, plan.choices.budget->quality);
  EXPECT_EQ(plan.scene.numerics.transfer, wanted.transfer);
  EXPECT_EQ(plan.scene.numerics.safety_factor, wanted.safety_factor);
  EXPECT_EQ(plan.scene.numerics.max_time_step, 1e-3) << "what the scene says itself stays";
}

TEST(BudgetPlan, ThatNoQualityKeepsIsSaid) {
  const Plan plan = plan_in_budget(scene_with(R"({"seconds": 1e-6})"), 1, kFree);
  EXPECT_GT(plan.choices.budget->seconds, 1e-6);
  EXPECT_EQ(plan.choices.budget->quality, extreme_point(&QualityPoint::cost_factor).quality);
  EXPECT_TRUE(std::any_of(plan.warnings.begin(), plan.warnings.end(), [](const std::string& w) {
    return w.find("more than its budget of 1e-06 s") != std::string::npos;
  }));
}

TEST(BudgetPlan, CountsPictures) {
  const Scene scene = scene_with(R"({"seconds": 1e6})");
  const Plan plan = plan_in_budget(scene, 1, DrawingCost{10, 10});
  EXPECT_GT(plan.choices.budget->seconds, 10 * plan.frames);
  EXPECT_LT(plan.choices.budget->seconds, 10 * plan.frames + 60);
}

TEST(BudgetPlan, OfAnErrorTakesTheCheapestQualityThatKeepsIt) {
  const Plan plan = plan_in_budget(scene_with(R"({"error": 1000})"), 1, kFree);
  EXPECT_EQ(plan.choices.budget->quality, extreme_point(&QualityPoint::cost_factor).quality);
  const double least = extreme_point(&QualityPoint::error).error;
  const Plan exact =
      plan_in_budget(scene_with(R"({"error": )" + std::to_string(1.001 * least) + "}"), 1, kFree);
  EXPECT_LE(exact.choices.budget->error, 1.001 * least);
  EXPECT_THROW(static_cast<void>(plan_in_budget(scene_with(R"({"error": 1e-9})"), 1, kFree)), InputError);
}

TEST(BudgetPlan, IsResolvedOnceAndKeptInThePlan) {
  const Plan plan = plan_in_budget(scene_with(R"({"seconds": 1e6})"), 1, kFree);
  const Plan again = read_plan(to_json(plan));
  EXPECT_EQ(to_json(again), to_json(plan));
  EXPECT_FALSE(plan.quality.empty());
  const Plan open = make_plan(scene_with(R"({"seconds": 1e6})"));
  EXPECT_FALSE(open.choices.budget);
  EXPECT_TRUE(std::any_of(open.warnings.begin(), open.warnings.end(), [](const std::string& w) {
    return w.find("budget is not looked at") != std::string::npos;
  }));
}

}  // namespace
}  // namespace lather::server
