// A state that is no longer sound stops the run at once, in words that help.

#include <gtest/gtest.h>

#include <limits>

#include "sim/mpm/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

TEST(Failure, ATooLongStepStopsWithStepTimeQuantityAndAdvice) {
  // Ten times the bound: the ball hits the ground and blows up.
  const std::vector<Override> set = {
      {"/numerics/time_step", "5e-3"},
      {"/gravity", "[0, -9.81, 0]"},
      {"/duration", "2"},
      {"/obstacles", R"([{"name": "ground", "shape": {"type": "plane"}, "friction": 0.5}])"}};
  const Scene scene = parse_scene(testing_support::ball_scene(), "", set);
  const Plan plan = make_plan(scene);
  ASSERT_FALSE(plan.warnings.empty());
  const auto simulation = Simulation::create(plan, 1);
  try {
    for (int i = 0; i <= scene.last_frame(); ++i)
      simulation->step_to_frame(i, [](const Progress&) { return true; });
    FAIL() << "the run should have stopped";
  } catch (const SimulationError& e) {
    EXPECT_TRUE(e.details().kind == "non-finite" || e.details().kind == "runaway") << e.details().kind;
    EXPECT_GT(e.details().step, 0);
    EXPECT_GT(e.details().time, 0);
    EXPECT_NE(e.details().advice.find("/numerics/time_step"), std::string::npos) << e.details().advice;
    EXPECT_NE(std::string(e.what()).find("step"), std::string::npos);
  }
  EXPECT_FALSE(simulation->report().frames.empty());
}

TEST(Failure, ASingleNotANumberIsSeenInTheSameStep) {
  const Plan plan = make_plan(parse_scene(testing_support::ball_scene()));
  const mpm::Model<float> model(plan);
  for (const Field field : {Field::kVelocity, Field::kVolumeChange, Field::kElasticStrain}) {
    mpm::State<float> state;
    state.sets.emplace_back(3, planned_fields(plan.scene, plan.scene.materials[0]), plan.scene.domain.box.min,
                            plan.scene.spacing);
    seed_points(plan.scene,
                [&](const Seed& s) { state.sets[0].add(s.position, s.velocity, s.velocity_gradient, s.id); });
    mpm::Stepper<float> stepper(model, 2);
    EXPECT_TRUE(stepper.step(state, 1e-4).extremes.finite);
    state.sets[0].values<float>(state.sets[0].tiles() / 2, field)[0] =
        std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(stepper.step(state, 1e-4).extremes.finite) << to_string(field);
  }
}

TEST(Failure, PointsThatLeaveAnOpenDomainAreRemovedAndCounted) {
  const std::vector<Override> set = {{"/bodies/0/velocity", "[100, 0, 0]"}, {"/numerics/time_step", "1e-4"}};
  const Report r = testing_support::run(testing_support::ball_scene(), set);
  EXPECT_EQ(r.frames.back().points, 0U);
  EXPECT_EQ(r.frames.back().points_left, r.frames.front().points);
  EXPECT_NEAR(r.frames.back().mass_left, r.frames.front().mass, 1e-6 * r.frames.front().mass);
}

}  // namespace
}  // namespace lather
