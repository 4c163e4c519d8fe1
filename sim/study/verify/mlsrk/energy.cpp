// A free elastic block without gravity and without the blend that swings for 20 periods of its slowest
// stretching mode, T = 2 L sqrt(rho/E): nothing does work on it, so energy and momentum stay.
//
// Forces are -dW/dx of the elastic energy where shape functions say how points move it, f_i . u_i sums to
// minus the power of the stress; so kinetic energy changes by as much, if it is made with the mass that
// forces are divided by. Velocities stand half a step off in a symplectic step: the energy oscillates by a
// share of first order in the step and does not drift (Hairer, Lubich and Wanner, Geometric Numerical
// Integration, IX.3). Own masses keep sum m u, too, to rounding. Lumped masses change as points move, which
// forces know nothing of.

#include <cmath>

#include "sim/study/scene_parts.h"
#include "sim/study/verify/mlsrk/cases.h"

namespace lather::study::mlsrk {
namespace {

constexpr double kHeight = 0.3;  // m
constexpr double kSpeed = 10;    // m/s, of waves along a bar
constexpr int kFramesPerPeriod = 10;
constexpr int kPeriods = 20;

Scene swinging_block(InertialMass mass, double safety) {
  const NeoHookeanParameters solid = {{1000, 1e5, 0.3}, {}};
  Scene scene = particle_scene("swinging block", kHeight / 12, solid);
  scene.domain.box = {Vec3(-2, -2, 0), Vec3(2, 2, 0)};
  scene.domain.boundary = Boundary::kOpen;
  scene.bodies.push_back(
      body_of(scene, box_at(Vec3(0.1, 0.5 * kHeight, 0), Vec3(0.2, kHeight, 1)), Vec3(0, -0.5 * kHeight, 0)));
  scene.bodies.front().velocity_gradient(1, 1) = 1;
  scene.numerics.mlsrk.velocity_blend = 1;
  scene.numerics.mlsrk.inertial_mass = mass;
  scene.numerics.safety_factor = safety;
  set_frames(scene, kPeriods * 2 * kHeight / kSpeed, kPeriods * kFramesPerPeriod);
  return scene;
}

std::vector<FrameMeasure> frames_of(const Scene& scene, int threads) {
  const auto simulation = Simulation::create(make_plan(scene), threads);
  for (int i = 0; i <= scene.last_frame(); ++i) run_to(*simulation, i);
  return simulation->report().frames;
}

/// Largest energy over the first one, less 1, with the mass used.
double gain(InertialMass mass, double safety, int threads) {
  const auto energy = [&](const FrameMeasure& m) {
    const double kinetic = mass == InertialMass::kOwn ? m.kinetic_energy : m.lumped.value().kinetic_energy;
    return kinetic + m.elastic_volume_energy + m.elastic_shear_energy;
  };
  const std::vector<FrameMeasure> frames = frames_of(swinging_block(mass, safety), threads);
  double most = 0;
  for (const FrameMeasure& m : frames) most = std::max(most, energy(m));
  return most / energy(frames.front()) - 1;
}

/// Largest change of both momenta of a jittered block that turns as it swings, over mass times its height
/// times the rate of strain.
struct Drift {
  double own = 0;     ///< of sum m u
  double lumped = 0;  ///< of sum M u with the lumped masses M
};
Drift drift(InertialMass mass, int threads) {
  Scene scene = swinging_block(mass, 0.2);
  scene.jitter = 0.3;
  scene.bodies.front().spin_deg.z() = 100;
  const std::vector<FrameMeasure> frames = frames_of(scene, threads);
  const FrameMeasure& first = frames.front();
  const double scale = first.mass * kHeight;
  const auto lumped_momentum = [](const FrameMeasure& m) { return Vec3(m.lumped.value().momentum.data()); };
  Drift d;
  for (const FrameMeasure& m : frames) {
    d.own = std::max(d.own, (m.momentum - first.momentum).norm() / scale);
    d.lumped = std::max(d.lumped, (lumped_momentum(m) - lumped_momentum(first)).norm() / scale);
  }
  return d;
}

}  // namespace

std::vector<Finding> verify_energy(int threads) {
  std::vector<Finding> findings;
  for (const InertialMass mass : {InertialMass::kOwn, InertialMass::kLumped}) {
    const bool own = mass == InertialMass::kOwn;
    std::vector<double> step;
    std::vector<double> error;
    for (const double safety : {0.2, 0.1, 0.05}) {
      step.push_back(safety);
      error.push_back(gain(mass, safety, threads));
    }
    findings.push_back({std::string("energy gained in 20 periods, ") + (own ? "own" : "lumped") +
                            " masses, at 0.2 0.1 0.05 of the step's bound: the last",
                        error.back(), 0.01, observed_order(step, error), 0.85});
  }
  // Rounding of 1e5 sums of 96 points' momenta; and, with lumped masses, what points of a jittered lattice
  // change theirs by as the body swings by 3 % of its height.
  const Drift with_own = drift(InertialMass::kOwn, threads);
  const Drift with_lumped = drift(InertialMass::kLumped, threads);
  findings.push_back({"drift of sum m u over m L du/dx, own masses", with_own.own, 1e-13});
  findings.push_back({"drift of sum m u over m L du/dx, lumped masses", with_lumped.own, 0.01});
  findings.push_back({"drift of sum M u over m L du/dx, lumped masses", with_lumped.lumped, 0.01});
  return findings;
}

}  // namespace lather::study::mlsrk
