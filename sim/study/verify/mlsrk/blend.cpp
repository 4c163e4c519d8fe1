// The blend of velocities [MLSRK eq. 12] smooths a shear wave v_x = A sin(k y) once a step by the share 1 -
// alpha of (k a)^2/6, the second moment of a cubic spline of scale a = R/2: a viscosity nu = (1 - alpha)
// a^2/(6 dt). Measured from the decay exp(-nu k^2 t) in a periodic box of a liquid without viscosity of its
// own.
//
// With alpha per step nu grows as 1/dt. The blend is defined per time instead, alpha = alpha_ref^(dt/dt_ref),
// and nu hardly depends on the step: (1 - alpha)/dt differs between dt_ref and dt_ref/4 by 1.9 % at alpha_ref
// = 0.95.

#include <cmath>
#include <numbers>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "sim/study/verify/mlsrk/cases.h"
#include "sim/study/verify/oscillation.h"

namespace lather::study::mlsrk {
namespace {

constexpr double kStep = 1e-3;  // s: the longest; sound takes 16 times as long through the finest spacing
constexpr LiquidParameters kLiquid = {1000, 1, 7, {}};

Scene shear_wave(int points, double support_radius, double step, double reference_step) {
  const double h = 1.0 / points;
  Scene scene = particle_scene("shear wave of particles", h, kLiquid);
  scene.domain.box = {Vec3::Zero(), Vec3(8 * h, 1, 0)};
  scene.domain.periodic = {true, true, false};
  add_layers(scene, scene.domain.box, 1,
             [](double y) { return Vec3(1e-3 * std::sin(2 * std::numbers::pi * y), 0, 0); });
  scene.numerics.mlsrk.support_radius = support_radius;
  scene.numerics.mlsrk.velocity_blend_reference_step = reference_step;
  scene.numerics.time_step = step;
  set_frames(scene, 200 * kStep, 1);
  return scene;
}

/// nu from the wave's decay, over that of the formula, by the function that plans show.
double relative_viscosity(const Scene& scene, int threads) {
  const auto simulation = Simulation::create(make_plan(scene), threads);
  const double before = wave_amplitude(*simulation, 1);
  run_to(*simulation, 1);
  const double rate = std::log(before / wave_amplitude(*simulation, 1)) / scene.duration;
  const double planned = velocity_blend_viscosity(scene, 1, scene.numerics.time_step);
  return rate / (4 * std::numbers::pi * std::numbers::pi * planned);
}

}  // namespace

std::vector<Finding> verify_blend(int threads) {
  std::vector<double> spacing;
  std::vector<double> error;
  for (const int points : {16, 32, 64}) {
    spacing.push_back(1.0 / points);
    error.push_back(std::abs(relative_viscosity(shear_wave(points, 4, kStep, kStep), threads) - 1));
  }
  const double usual = relative_viscosity(shear_wave(64, 3, kStep, kStep), threads);
  const double long_step = relative_viscosity(shear_wave(32, 4, kStep, kStep), threads);
  const double per_step = relative_viscosity(shear_wave(32, 4, kStep / 4, kStep / 4), threads);
  const Scene quarter = shear_wave(32, 4, kStep / 4, kStep);
  const double per_time = relative_viscosity(quarter, threads) *
                          velocity_blend_viscosity(quarter, 1, kStep / 4) /
                          velocity_blend_viscosity(quarter, 1, kStep);
  // The formula is the first term of a series in (k a)^2, whose next one is (k a)^2/12 of it: 0.32 % at 64
  // points a wave with R = 4 h. The sums over a lattice are the spline's integrals where a is a multiple of
  // h; at R = 3 h its second moment is 0.5 % larger for good.
  return {{"viscosity against the formula, R/h = 4, L/h = 16 32 64: the finest", error.back(), 0.004,
           observed_order(spacing, error), 1.9},
          {"viscosity against the formula, R/h = 3, L/h = 64", std::abs(usual - 1), 0.006},
          {"blend per step: at a quarter of the step, over 4 times as much, less 1",
           std::abs(per_step / long_step - 1), 0.01},
          {"blend per time: at a quarter of the step, over as much, less 1",
           std::abs(per_time / long_step - 1), 0.025}};
}

}  // namespace lather::study::mlsrk
