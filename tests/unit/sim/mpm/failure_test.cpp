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

/// The error that ends a block in free fall in steps of spacing / wave speed, which quadratic kernels in 2D
/// do not bear.
SimulationError::Details error_of_falling_block(const std::string& allowed_energy_gain) {
  static const char* const kBlock = R"({
    "lather": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [0.12, 0.12]}, "duration": 0.1, "frame_rate": 200,
    "spacing": 0.01,
    "materials": [{"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e5,
                   "poisson_ratio": 0}],
    "bodies": [{"name": "block", "material": "jelly",
                "shape": {"type": "box", "size": [0.06, 0.06], "translate": [0.05, 0.08]}}],
    "numerics": {"kernel": "quadratic", "time_step": 1e-3}})";
  const Scene scene = parse_scene(kBlock, "", {{"/numerics/allowed_energy_gain", allowed_energy_gain}});
  const auto simulation = Simulation::create(make_plan(scene), 1);
  try {
    for (int i = 0; i <= scene.last_frame(); ++i)
      simulation->step_to_frame(i, [](const Progress&) { return true; });
  } catch (const SimulationError& e) {
    return e.details();
  }
  return {};
}

TEST(Failure, EnergyThatNothingGaveEndsARunUnlessItIsAllowed) {
  const SimulationError::Details gained = error_of_falling_block("0.1");
  EXPECT_EQ(gained.kind, "energy");
  EXPECT_NE(gained.advice.find("/numerics/time_step"), std::string::npos) << gained.advice;
  EXPECT_NE(gained.advice.find("/numerics/allowed_energy_gain"), std::string::npos) << gained.advice;
  const SimulationError::Details burst = error_of_falling_block("\"infinity\"");
  EXPECT_NE(burst.kind, "energy");
  EXPECT_TRUE(burst.kind.empty() || burst.step > gained.step) << burst.kind;
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
