// The PIC part of the FLIP/PIC blend smooths velocities once a step, which is a viscosity: with the share
// alpha of FLIP in a step dt and cubic splines nu = (1 - alpha) h^2/(3 dt). Measured from the decay exp(-nu
// k^2 t) of a shear wave v_x = A sin(k y) in a periodic box of a material without any shear stress of its
// own.
//
// With alpha per step nu grows as 1/dt. The blend is defined per time instead, alpha = alpha_ref^(dt/dt_ref),
// and nu hardly depends on the step: (1 - alpha)/dt differs between dt_ref and dt_ref/4 by 1.9 % at alpha_ref
// = 0.95.

#include "sim/study/verify/blend_viscosity.h"

#include <cmath>
#include <numbers>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "sim/study/verify/oscillation.h"

namespace lather::study {
namespace {

constexpr double kAlpha = 0.95;
constexpr double kStep =
    1e-3;  // s: the longest; a sound wave takes ten times as long through the finest cell
constexpr HerschelBulkleyParameters kInviscid = {1000, 1, 1e-6, 0, 0, 1};

Scene shear_wave(int cells, double step, double reference_step) {
  const double h = 1.0 / cells;
  Scene scene;
  scene.name = "shear wave";
  scene.dimension = 2;
  scene.domain.box = {Vec3::Zero(), Vec3(4 * h, 1, 0)};
  scene.domain.periodic = {true, true, false};
  scene.gravity = Vec3::Zero();
  scene.spacing = h;
  scene.points_per_cell = 4;
  scene.materials.push_back(material_of(kInviscid));
  add_layers(scene, scene.domain.box, 1,
             [](double y) { return Vec3(1e-3 * std::sin(2 * std::numbers::pi * y), 0, 0); });
  scene.numerics.flip_blend = kAlpha;
  scene.numerics.flip_blend_reference_step = reference_step;
  scene.numerics.time_step = step;
  scene.numerics.precision = Precision::kDouble;
  set_frames(scene, 200 * kStep, 1);
  return scene;
}

/// nu from the wave's decay, m^2/s.
double measured_viscosity(int cells, double step, double reference_step, int threads) {
  const Scene scene = shear_wave(cells, step, reference_step);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  const double before = wave_amplitude(*simulation, 1);
  run_to(*simulation, 1);
  const double wave_number = 2 * std::numbers::pi;
  return std::log(before / wave_amplitude(*simulation, 1)) / scene.duration / (wave_number * wave_number);
}

/// The formula, m^2/s, by the function that plans show.
double planned_viscosity(int cells, double step, double reference_step) {
  const Scene scene = shear_wave(cells, step, reference_step);
  return blend_viscosity(scene, kInviscid.density, step) / kInviscid.density;
}

}  // namespace

std::vector<Finding> verify_blend_viscosity(int threads) {
  std::vector<double> spacing;
  std::vector<double> error;
  for (const int cells : {8, 16, 32}) {
    spacing.push_back(1.0 / cells);
    error.push_back(std::abs(
        measured_viscosity(cells, kStep, kStep, threads) / planned_viscosity(cells, kStep, kStep) - 1));
  }
  const double long_step = measured_viscosity(16, kStep, kStep, threads);
  const double per_step = measured_viscosity(16, kStep / 4, kStep / 4, threads);
  const double per_time = measured_viscosity(16, kStep / 4, kStep, threads);
  // The formula is the first term of a series in (k h)^2; the next is (k h)^2/6: 0.64 % at 32 cells a wave.
  return {{"viscosity against the formula, relative, L/h = 8 16 32: the finest", error.back(), 0.01,
           observed_order(spacing, error), 1.8},
          {"blend per step: at a quarter of the step, over 4 times as much, less 1",
           std::abs(per_step / (4 * long_step) - 1), 0.01},
          {"blend per time: at a quarter of the step, over as much, less 1",
           std::abs(per_time / long_step - 1), 0.025}};
}

}  // namespace lather::study
