// The semi-implicit step: what it must keep, that it tends to the explicit one, and that it bears long steps.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/kernel_levels.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::ball_scene;
using testing_support::run;

const Override kSemiImplicit = {"/numerics/integration", "semi-implicit"};

/// A cube of elastic jelly, pressed flat along y by 1 % to start with, in free space: it rings.
std::string ringing_cube() {
  return R"({"lather": 1, "name": "cube", "domain": {"min": [-1, -1, -1], "max": [1, 1, 1], "boundary": "open"},
    "gravity": [0, 0, 0], "duration": 0.1, "frame_rate": 10, "spacing": 0.05,
    "materials": [{"name": "jelly", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 3e4, "yield_stress": "infinity",
                   "viscosity": 0, "flow_index": 1}],
    "bodies": [{"name": "cube", "material": "jelly", "shape": {"type": "box", "size": [0.3, 0.3, 0.3]},
                "velocity_gradient": [[0.3, 0, 0], [0, -0.5, 0], [0, 0, 0.3]]}],
    "numerics": {"precision": "double", "solver_tolerance": 1e-5}})";
}

TEST(SemiImplicit, KeepsMomentumInFreeFlightHoweverEarlyTheSolverStops) {
  for (const char* transfer : {"flip", "apic"})
    for (const char* precision : {"float", "double"})
      for (const char* iterations : {"2", "200"}) {
        SCOPED_TRACE(testing::Message() << transfer << ' ' << precision << ' ' << iterations);
        const Report r =
            run(ball_scene(), {kSemiImplicit,
                               {"/numerics/transfer", transfer},
                               {"/numerics/precision", precision},
                               {"/numerics/solver_iterations", iterations},
                               {"/numerics/time_step", "2e-3"},
                               {"/bodies/0/velocity", "[0.3, -0.2, 0.1]"},
                               {"/bodies/0/spin_deg", "[0, 0, 400]"},
                               {"/bodies/0/velocity_gradient", "[[0, 8, 0], [0, 0, 0], [0, 0, 0]]"}});
        const FrameMeasure& a = r.frames.front();
        const FrameMeasure& b = r.frames.back();
        ASSERT_EQ(r.steps, 50U);
        EXPECT_EQ(a.mass, b.mass);
        EXPECT_EQ(r.solver.unconverged > 0, iterations[0] == '2' && iterations[1] == 0);
        // Rounding of each step is independent of the last one's; the forces in an iteration are up to
        // (dt omega)^2, here 25, times the momenta.
        const double epsilon = precision[0] == 'f' ? std::numeric_limits<float>::epsilon()
                                                   : std::numeric_limits<double>::epsilon();
        EXPECT_LT((b.momentum - a.momentum).norm(),
                  25 * 8 * epsilon * std::sqrt(50.0) * a.mass * a.max_speed);
      }
}

TEST(SemiImplicit, FreeFallIsExactAndCostsNoIteration) {
  const Report r =
      run(ball_scene(), {kSemiImplicit, {"/gravity", "[0, -9.81, 0]"}, {"/numerics/time_step", "1e-3"}});
  const double n = 100;
  ASSERT_EQ(r.steps, 100U);
  const double fallen = r.frames.back().center_of_mass.y() - r.frames.front().center_of_mass.y();
  const double exact = -9.81 * 1e-6 * n * (n + 1) / 2;  // symplectic Euler
  const double epsilon = std::numeric_limits<float>::epsilon();
  EXPECT_NEAR(fallen, exact, n * epsilon * std::abs(exact) + 1e-12);
  EXPECT_EQ(r.solver.solves, 100U);
  EXPECT_EQ(r.solver.iterations, 0U);
}

TEST(SemiImplicit, TendsToTheExplicitStepAtFirstOrder) {
  // Against explicit steps of the same length, since the transfers' own damping counts steps. A quarter of a
  // wave's way through the cube; the tolerance is for what is of second order.
  const std::vector<Override> shorter = {
      {"/duration", "2e-3"}, {"/frame_rate", "500"}, {"/numerics/transfer", "apic"}};
  const auto energy = [&](const char* integration, double step) {
    auto set = shorter;
    set.push_back({"/numerics/integration", integration});
    set.push_back({"/numerics/time_step", std::to_string(step)});
    const FrameMeasure f = run(ringing_cube(), set).frames.back();
    return f.elastic_volume_energy + f.elastic_shear_energy;
  };
  const auto difference = [&](double step) {
    return std::abs(energy("semi-implicit", step) / energy("explicit", step) - 1);
  };
  const double coarse = difference(1e-4);
  const double fine = difference(5e-5);
  EXPECT_LT(fine, 0.1);
  EXPECT_NEAR(coarse / fine, 2, 0.3) << coarse << ' ' << fine;
}

TEST(SemiImplicit, AnElasticBlockIsStableFarBeyondTheExplicitLimit) {
  // The bound is h / c = 1.3 ms; explicit steps fail above about that. Waves are damped, energy never grows.
  const auto energy = [](const FrameMeasure& f) {
    return f.kinetic_energy + f.elastic_volume_energy + f.elastic_shear_energy;
  };
  EXPECT_THROW(run(ringing_cube(), {{"/numerics/time_step", "5e-3"}, {"/duration", "1"}}), SimulationError);
  for (const char* transfer : {"flip", "apic"})
    for (const char* step : {"0.0133", "0.1"}) {
      SCOPED_TRACE(testing::Message() << transfer << ' ' << step);
      const Report r = run(ringing_cube(), {kSemiImplicit,
                                            {"/numerics/transfer", transfer},
                                            {"/numerics/time_step", step},
                                            {"/numerics/solver_tolerance", "1e-3"},
                                            {"/numerics/solver_iterations", "1000"},
                                            {"/duration", step[2] == '0' ? "0.3" : "1"}});
      EXPECT_EQ(r.solver.unconverged, 0U);
      const double start = energy(r.frames.front());
      double before = 1.05 * start;
      for (const FrameMeasure& f : r.frames) {
        EXPECT_LE(energy(f), before + 1e-6 * start);
        before = energy(f);
      }
    }
}

TEST(SemiImplicit, ABodySlidesOnFrictionalGroundAsFarAsWithExplicitSteps) {
  const std::string scene =
      R"({"lather": 1, "name": "slide", "domain": {"min": [-0.4, 0, -0.4], "max": [0.4, 0.8, 0.4]},
    "duration": 1, "frame_rate": 10, "spacing": 0.05,
    "materials": [{"name": "jelly", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 3e4, "yield_stress": "infinity",
                   "viscosity": 0, "flow_index": 1}],
    "bodies": [{"name": "cube", "material": "jelly", "velocity": [0.5, 0, 0],
                "shape": {"type": "box", "size": [0.3, 0.3, 0.3], "translate": [-0.1, 0.25, 0]}}],
    "obstacles": [{"name": "ground", "shape": {"type": "plane", "translate": [0, 0.1, 0]}, "friction": 0.3}]})";
  const Report expected = run(scene, {});
  const Report found = run(scene, {kSemiImplicit});
  ASSERT_LT(found.steps * 9, expected.steps);
  const FrameMeasure& e = expected.frames.back();
  const FrameMeasure& f = found.frames.back();
  // Both at rest but for a rocking on the soft edge of contact, which fades slowly: a hundredth of the energy
  // at first.
  EXPECT_LT(f.kinetic_energy, 0.01 * found.frames.front().kinetic_energy);
  // v^2 / (2 mu g) = 42 mm; a tenth of a cell, 5 mm, between the two.
  EXPECT_GT(e.center_of_mass.x() - expected.frames.front().center_of_mass.x(), 0.02);
  EXPECT_NEAR(f.center_of_mass.x(), e.center_of_mass.x(), 5e-3);
  EXPECT_NEAR(f.center_of_mass.y(), e.center_of_mass.y(), 5e-3);
}

TEST(SemiImplicit, IsBitEqualForAnyNumberOfThreadsAndAfterRestore) {
  const std::vector<Override> set = {
      kSemiImplicit,
      {"/bodies/0/velocity", "[0.3, -2, 0.1]"},
      {"/obstacles", R"([{"name": "ground", "shape": {"type": "plane", "translate": [0, 0.2, 0]},
                                                         "friction": 0.3}])"},
      {"/numerics/time_step", "2e-3"},
      {"/frame_rate", "50"}};
  for (const KernelLevel level : testing_support::levels_here()) {
    const Report one = run(ball_scene(), set, 1, level);
    ASSERT_GT(one.solver.iterations, one.solver.solves);
    for (const int threads : {2, 5})
      EXPECT_EQ(run(ball_scene(), set, threads, level).frames.back().fingerprint,
                one.frames.back().fingerprint);

    const Plan plan = make_plan(parse_scene(ball_scene(), "", set), {level});
    const auto going = [](const Progress&) { return true; };
    const auto first = Simulation::create(plan, 2);
    first->step_to_frame(2, going);
    const auto second = Simulation::create(plan, 1);
    second->restore(first->save());
    for (int i = 3; i <= plan.scene.last_frame(); ++i) second->step_to_frame(i, going);
    EXPECT_EQ(second->report().frames.back().fingerprint, one.frames.back().fingerprint);
    EXPECT_EQ(second->report().solver.iterations, one.solver.iterations);
  }
}

TEST(SemiImplicit, AnExplicitPlanKnowsNothingOfIt) {
  const auto plan = [](const std::vector<Override>& set) {
    return make_plan(parse_scene(ball_scene(), "", set));
  };
  const Plan plain = plan({});
  const Plan solving = plan({kSemiImplicit});
  EXPECT_EQ(solving.stages.size(), plain.stages.size() + 1);
  for (const std::string& stage : plain.stages) EXPECT_NE(stage, "solve velocities");
  EXPECT_EQ(plain.materials[0].bytes_per_point, solving.materials[0].bytes_per_point);
  EXPECT_GT(solving.memory_bytes, plain.memory_bytes);
  // Automatic steps: ten times as long.
  const Plan free = plan({{"/numerics/time_step", "0"}});
  const Plan free_solving = plan({kSemiImplicit, {"/numerics/time_step", "0"}});
  EXPECT_NEAR(free_solving.time_step / free.time_step, 10, 0.5);  // whole steps to a frame
  EXPECT_EQ(run(ball_scene(), {{"/duration", "0.1"}}).solver.solves, 0U);
}

}  // namespace
}  // namespace lather
