// What the time step itself takes from an elastic shear wave v_x = A sin(k y) cos(omega t), omega = k
// sqrt(mu/rho): as much as the viscosity that plans show, exp(-nu k^2 t/2).

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "sim/study/verify/oscillation.h"

namespace lather::study {
namespace {

constexpr double kWaveNumber = 2 * std::numbers::pi;
constexpr HerschelBulkleyParameters kElastic = {1000, 1e5, 3e4, std::numeric_limits<double>::infinity(),
                                                0,    1};
constexpr int kPeriods = 4;
constexpr int kFramesPerPeriod = 40;

Scene shear_wave(int cells) {
  const double h = 1.0 / cells;
  Scene scene;
  scene.name = "shear wave";
  scene.dimension = 2;
  scene.domain.box = {Vec3::Zero(), Vec3(4 * h, 1, 0)};
  scene.domain.periodic = {true, true, false};
  scene.gravity = Vec3::Zero();
  scene.spacing = h;
  scene.points_per_cell = 4;
  scene.materials.push_back(material_of(kElastic));
  add_layers(scene, scene.domain.box, 1,
             [](double y) { return Vec3(1e-5 * std::sin(kWaveNumber * y), 0, 0); });
  scene.numerics.precision = Precision::kDouble;
  const double period =
      2 * std::numbers::pi / (kWaveNumber * std::sqrt(kElastic.shear_modulus / kElastic.density));
  set_frames(scene, kPeriods * period, kPeriods * kFramesPerPeriod);
  return scene;
}

/// Loss of amplitude a period, measured, and as the plan's viscosity says.
struct Loss {
  double measured = 0;
  double planned = 0;
};

Loss loss_of(const Scene& scene) {
  const Plan plan = make_plan(scene);
  const auto simulation = Simulation::create(plan, 1);
  std::vector<double> samples;
  for (int i = 0; i <= scene.last_frame(); ++i) {
    run_to(*simulation, i);
    samples.push_back(wave_amplitude(*simulation, 1));
  }
  const double nu = plan.materials.front().step_viscosity / kElastic.density;
  const double period = scene.duration / kPeriods;
  return {oscillation_of(samples).loss_per_period,
          1 - std::exp(-nu * kWaveNumber * kWaveNumber * period / 2)};
}

TEST(StepViscosity, OfSemiImplicitStepsIsWhatTheyTake) {
  Scene scene = shear_wave(32);
  scene.numerics.integration = Integration::kSemiImplicit;
  scene.numerics.transfer = Transfer::kApic;
  scene.numerics.solver_tolerance = 1e-6;
  scene.numerics.time_step = scene.duration / kPeriods / 120;  // omega dt = 0.05
  const Loss loss = loss_of(scene);
  // The next order of the step is omega dt over the first, and the grid takes 0.4 (k h)^3 = 0.3 % beside it.
  EXPECT_NEAR(loss.measured, loss.planned, 0.05 * loss.planned + 0.003);
  EXPECT_GT(loss.planned, 0.1);
}

TEST(StepViscosity, OfExplicitStepsIsForWavesOfEightCells) {
  Scene scene = shear_wave(8);
  scene.numerics.flip_blend = 1;
  const Loss loss = loss_of(scene);
  // The smoothing weight's next term over its first is (k h)^2/6, a tenth at eight cells, in a loss that has
  // it twice and in the frequency once.
  EXPECT_NEAR(loss.measured, loss.planned, 0.3 * loss.planned);
}

}  // namespace
}  // namespace lather::study
