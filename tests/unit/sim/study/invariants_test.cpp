// Frames that are not sound are seen, each by what is wrong with it.

#include "sim/study/stability/invariants.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "sim/plan/plan.h"
#include "sim/report/energy_balance.h"
#include "tests/support/run_scene.h"

namespace lather::study {
namespace {

Scene scene_of(const std::vector<Override>& changes = {}) {
  return parse_scene(testing_support::ball_scene(), "", changes);
}

FrameMeasure first_frame(const Scene& scene) {
  const auto simulation = Simulation::create(make_plan(scene), 1);
  simulation->step_to_frame(0, [](const Progress&) { return true; });
  return simulation->report().frames.front();
}

TEST(Unsoundness, NamesWhatIsWrong) {
  const Scene scene = scene_of({{"/gravity", "[0, -9.81, 0]"}, {"/domain/boundary", "slip"}});
  const FrameMeasure start = first_frame(scene);
  EXPECT_EQ(unsoundness(scene, start, start), "");
  const auto after = [&](const std::function<void(FrameMeasure&)>& change) {
    FrameMeasure m = start;
    change(m);
    return unsoundness(scene, start, m);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(after([&](FrameMeasure& m) { m.elastic_shear_energy = nan; }),
            "the elastic energy of shear is not a number");
  EXPECT_NE(after([](FrameMeasure& m) { m.mass *= 1 + 1e-9; }).find("the mass is"), std::string::npos);
  EXPECT_EQ(after([](FrameMeasure& m) { m.mass_left = 0.25 * m.mass, m.mass *= 0.75; }), "");
  EXPECT_NE(after([&](FrameMeasure& m) {
              m.highest.x() = scene.domain.box.max.x() + 1e-3 * scene.spacing;
            }).find("the highest coordinate"),
            std::string::npos);
  EXPECT_NE(after([&](FrameMeasure& m) {
              m.lowest.y() = scene.domain.box.min.y() - 1e-3 * scene.spacing;
            }).find("the lowest coordinate"),
            std::string::npos);
  const double energy = total_energy(scene, start);
  EXPECT_EQ(after([&](FrameMeasure& m) { m.kinetic_energy += 0.09 * energy; }), "");
  EXPECT_NE(after([&](FrameMeasure& m) { m.kinetic_energy += 0.11 * energy; }).find("the energy is"),
            std::string::npos);
}

TEST(Unsoundness, LeavesEnergyAloneWhereSomethingGivesIt) {
  const std::string moving = R"([{"name": "fist", "shape": {"type": "sphere", "radius": 0.01},
                                  "motion": {"type": "linear", "velocity": [1, 0, 0]}}])";
  const Scene scene = scene_of({{"/obstacles", moving}});
  ASSERT_TRUE(is_driven(scene));
  FrameMeasure more = first_frame(scene);
  more.kinetic_energy += 1e6;
  EXPECT_EQ(unsoundness(scene, first_frame(scene), more), "");
}

TEST(Examine, TellsHowARunEnds) {
  EXPECT_EQ(examine(scene_of({{"/duration", "0.02"}}), {1000}).outcome, Outcome::kHeld);
  EXPECT_EQ(examine(scene_of({{"/bodies/0/shape/translate", "[9, 9, 9]"}}), {1000}).outcome,
            Outcome::kRefused);
  // Far beyond the step bound, onto the ground.
  const Verdict burst = examine(
      scene_of({{"/numerics/time_step", "5e-3"},
                {"/gravity", "[0, -9.81, 0]"},
                {"/duration", "2"},
                {"/obstacles", R"([{"name": "ground", "shape": {"type": "plane"}, "friction": 0.5}])"}}),
      {100'000});
  EXPECT_EQ(burst.outcome, Outcome::kStopped);
  EXPECT_NE(burst.why.find("/numerics/time_step"), std::string::npos) << burst.why;
  EXPECT_GT(burst.steps, 0U);
}

}  // namespace
}  // namespace lather::study
