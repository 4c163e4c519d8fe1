// Diffusion of concentrations [MLSRK eq. 13-16]. With H = (c - 1/2)^2 a wave c - 1/2 = A cos(k x) at rest
// fades as exp(-q t), q = L (2 k^2 + eps^2 k^4). In a periodic box whose points are of one material a column,
// each with the wave's concentration there.
//
// Shape functions smooth a wave by (k a)^2/6, a = R/2, once from potentials to fluxes and once from those to
// gains: q is smaller by (k a)^2/3. The Laplacian in the potential, 2 (1 - w)/s with w = 1 - s k^2/2 + 0.3
// a^4 k^4/24 the transform of a cubic spline and s = a^2/3, adds 0.075 (k a)^2 in the term with eps.
//
// And sum m c of a body that turns and swings: what one point gains others lose, so that only rounding is
// left, of c itself in double precision whatever the run's.

#include <cmath>
#include <numbers>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "sim/study/verify/mlsrk/cases.h"

namespace lather::study::mlsrk {
namespace {

constexpr double kMobility = 0.01;       // L, m^2/s
constexpr double kInterfaceWidth = 0.1;  // eps, m
constexpr double kWaveNumber = 2 * std::numbers::pi;
constexpr double kSquared = kWaveNumber * kWaveNumber;
constexpr NeoHookeanParameters kSolid = {{1000, 1e3, 0.3}, {}};

/// 2 k^2 and eps^2 k^4, 1/m^2.
constexpr double kBulkTerm = 2 * kSquared;
constexpr double kSurfaceTerm = kInterfaceWidth * kInterfaceWidth * kSquared * kSquared;

Material material_with(const std::string& name, double concentration, double mobility, double density) {
  NeoHookeanParameters solid = kSolid;
  solid.elastic.density = density;
  Material m = material_of(solid);
  m.name = name;
  m.phase = Phase{concentration, mobility, {}};
  return m;
}

/// q over the exact one, from what an explicit step takes of the wave: q dt of it.
double relative_rate(const Scene& scene, int threads) {
  const auto simulation = Simulation::create(make_plan(scene), threads);
  const double before = concentration_amplitude(*simulation);
  run_to(*simulation, 1);
  const auto steps = static_cast<double>(simulation->report().steps);
  const double kept = std::pow(concentration_amplitude(*simulation) / before, 1 / steps);
  return (1 - kept) * steps / scene.duration / (kMobility * (kBulkTerm + kSurfaceTerm));
}

/// A block, half dry and half wet, and a stone on it that takes no part; all turns and swings.
Scene turning_block(Precision precision) {
  constexpr double h = 0.05;
  constexpr double kStep = 1e-4;
  Scene scene = particle_scene("turning block", h, kSolid);
  scene.numerics.precision = precision;
  scene.domain.box = {Vec3(-0.3, -0.3, 0), Vec3(0.3, 0.3, 0)};
  scene.jitter = 0.3;
  scene.materials = {material_with("dry", 0, 2e-3, 500), material_with("wet", 1, 1e-3, 1000)};
  scene.materials.push_back(scene.materials.back());
  scene.materials.back().name = "stone";
  scene.materials.back().phase.reset();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 size = i < 2 ? Vec3(2 * h, 4 * h, 1) : Vec3(4 * h, h, 1);
    scene.bodies.push_back(body_of(scene, box_at(Vec3(i == 0   ? -h
                                                      : i == 1 ? h
                                                               : 0,
                                                      i < 2 ? 0 : 2.5 * h, 0),
                                                 size)));
    scene.bodies.back().material = scene.materials[i].name;
    scene.bodies.back().velocity_gradient << 0.3, -1, 0, 1, -0.3, 0, 0, 0, 0;
  }
  scene.numerics.time_step = kStep;
  scene.numerics.mlsrk.velocity_blend = 0.999;
  set_frames(scene, 1e5 * kStep, 10);
  return scene;
}

/// Change of sum m c, relative.
double drift(Precision precision, int threads) {
  const Scene scene = turning_block(precision);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  run_to(*simulation, scene.last_frame());
  const std::vector<FrameMeasure>& frames = simulation->report().frames;
  return std::abs(frames.back().phases.value().component_mass / frames.front().phases.value().component_mass -
                  1);
}

}  // namespace

Scene concentration_wave(int points) {
  const double h = 1.0 / points;
  Scene scene = particle_scene("wave of concentration", h, kSolid);
  scene.materials.clear();
  scene.domain.box = {Vec3::Zero(), Vec3(1, 8 * h, 0)};
  scene.domain.periodic = {true, true, false};
  for (int i = 0; i < points; ++i) {
    const double x = (i + 0.5) * h;
    const std::string name = "column " + std::to_string(i);
    scene.materials.push_back(material_with(name, 0.5 + 0.4 * std::cos(kWaveNumber * x), kMobility, 1000));
    scene.bodies.push_back(body_of(scene, box_at(Vec3(x, 4 * h, 0), Vec3(h, 1, 1))));
    scene.bodies.back().material = name;
  }
  scene.numerics.mlsrk.phases.interface_width = kInterfaceWidth;
  set_frames(scene, 0.1 / (kMobility * (kBulkTerm + kSurfaceTerm)), 1);
  return scene;
}

double concentration_amplitude(const Simulation& simulation) {
  double sum = 0;
  double count = 0;
  simulation.visit_points([&](const PointState& p) {
    sum += p.concentration * std::cos(kWaveNumber * p.position.x());
    ++count;
  });
  return 2 * sum / count;
}

std::vector<Finding> verify_diffusion(int threads) {
  std::vector<Finding> findings;
  for (const double support_radius : {2.0, 3.0}) {
    std::vector<double> spacing;
    std::vector<double> error;
    for (const int points : {16, 32, 64}) {
      spacing.push_back(1.0 / points);
      Scene scene = concentration_wave(points);
      scene.numerics.mlsrk.support_radius = support_radius;
      error.push_back(std::abs(relative_rate(scene, threads) - 1));
    }
    const double ka = kWaveNumber * 0.5 * support_radius * spacing.back();
    const double predicted = ka * ka * (1.0 / 3 + 0.075 * kSurfaceTerm / (kBulkTerm + kSurfaceTerm));
    findings.push_back({"rate at which a wave fades, R/h = " +
                            std::to_string(static_cast<int>(support_radius)) + ", L/h = 16 32 64: the finest",
                        error.back(), 1.05 * predicted, observed_order(spacing, error), 1.9});
  }
  // A step rounds each of 16 points' c by 1e-16 at the most, at random: 1e-14 in 1e5 steps. In single
  // precision it rounds what a point gains, by 6e-8 of what passes between neighbours; that is 1e-2 of c over
  // the whole run.
  findings.push_back({"sum m c over 1e5 steps, double precision", drift(Precision::kDouble, threads), 2e-14});
  findings.push_back({"sum m c over 1e5 steps, single precision", drift(Precision::kFloat, threads), 1e-8});
  return findings;
}

}  // namespace lather::study::mlsrk
