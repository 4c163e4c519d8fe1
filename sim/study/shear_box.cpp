#include "sim/study/shear_box.h"

#include <algorithm>
#include <cmath>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

constexpr int kGap = 12;             // cells between the innermost wall nodes
constexpr int kWallLayers = 4;       // layers of nodes that a point's kernel can reach
constexpr double kIncrement = 5e-4;  // shear in 0.3 of the time that a wave takes through a cell

/// A wall node's layer as an obstacle. The walls are stacks of sheets, one to a layer of nodes, each with the
/// speed that the flow would have there. A single rigid wall acts as if it stood 0.65 cells behind its first
/// node, whatever the gap (cubic kernels; measured from the stress at gaps of 13 and 25 cells), which would
/// change the shear rate by 10 % at this gap and hide what is measured.
Obstacle sheet(double layer, double rate, double h) {
  const double y = layer * h;
  Obstacle o;
  o.name = "sheet " + std::to_string(layer);
  o.shape = box_at({0, y, 0}, {100 * h, 0.2 * h, 100 * h});
  o.adhesive = true;
  o.visible = false;
  LinearMotion motion;
  motion.velocity = {rate * y, 0, 0};
  o.motion = motion;
  return o;
}

/// The law with the density and the bulk modulus of the box.
HerschelBulkleyParameters in_box(const HerschelBulkleyParameters& law) {
  HerschelBulkleyParameters own = law;
  own.density = 77.7;
  own.bulk_modulus = std::max(20 * law.shear_modulus, 2000.0);
  return own;
}

double box_spacing(const HerschelBulkleyParameters& own, double rate) {
  return kIncrement / rate * wave_speed(own) / 0.3;
}

}  // namespace

Scene shear_box_scene(const HerschelBulkleyParameters& law, const StartUpRequest& request) {
  const HerschelBulkleyParameters own = in_box(law);
  const double h = box_spacing(own, request.rate);
  Scene scene;
  scene.name = "simple shear";
  scene.domain.box = {Vec3(-2, -kGap, -2) * h, Vec3(2, kGap, 2) * h};
  scene.domain.periodic = {true, false, true};
  scene.gravity = Vec3::Zero();
  scene.spacing = h;
  scene.points_per_cell = 8;
  scene.materials.push_back(material_of(own));
  // The slab reaches 3 cells into each wall, so that the kernels of all free nodes are full.
  scene.bodies.push_back(body_of(scene, box_at(Vec3::Zero(), Vec3(10, kGap + 6, 10) * h)));
  scene.bodies.front().velocity_gradient(0, 1) = request.rate;
  for (int layer = kGap / 2; layer < kGap / 2 + kWallLayers; ++layer)
    for (const int side : {-1, 1}) scene.obstacles.push_back(sheet(side * layer, request.rate, h));
  scene.numerics.transfer = Transfer::kApic;
  // Oobleck at 0.1/s carries 0.09 Pa beside a bulk modulus of 10^5 Pa; float's noise of J alone is 2 % of
  // that.
  scene.numerics.precision = Precision::kDouble;
  set_frames(scene, request.time, static_cast<int>(request.steps));
  return scene;
}

Scene particle_shear_box_scene(const HerschelBulkleyParameters& law, const StartUpRequest& request) {
  // A point's gradient reaches 3 points far, and so does the stress that moves it: with five layers the
  // innermost free points still have all of what moves them.
  constexpr int kWall = 5;
  constexpr int kHalf = kGap / 2;
  const HerschelBulkleyParameters own = in_box(law);
  const double h = box_spacing(own, request.rate);
  Scene scene = particle_scene("simple shear of particles", h, own);
  scene.domain.box = {Vec3(-4, -kHalf - kWall - 1, 0) * h, Vec3(4, kHalf + kWall + 1, 0) * h};
  scene.domain.periodic = {true, false, false};
  scene.bodies.push_back(body_of(scene, box_at(Vec3::Zero(), Vec3(20, 2 * (kHalf + kWall), 20) * h)));
  scene.bodies.front().velocity_gradient(0, 1) = request.rate;
  for (int layer = 0; layer < kWall; ++layer)
    for (const int side : {-1, 1})
      scene.obstacles.push_back(sheet(side * (kHalf + layer + 0.5), request.rate, h));
  // The flow is linear, so the blend takes nothing of it; but without it noise grows at elastic strains of
  // 0.5.
  scene.numerics.mlsrk.velocity_blend_reference_step = planned_step(scene, step_bound(scene));
  set_frames(scene, request.time, static_cast<int>(request.steps));
  return scene;
}

double middle_half(const Scene& shear_box) {
  return kGap / 4.0 * shear_box.spacing;
}

ShearStress middle_stress(const Simulation& simulation, double half) {
  ShearStress sum;
  double count = 0;
  simulation.visit_points([&](const PointState& p) {
    if (std::abs(p.position.y()) >= half) return;
    const ShearStress s = shear_stress(p.stress.data());
    sum.tau_xy += s.tau_xy;
    sum.n1 += s.n1;
    sum.s += s.s;
    ++count;
  });
  return {sum.tau_xy / count, sum.n1 / count, sum.s / count};
}

StartUp start_up_in_box(const HerschelBulkleyParameters& law, const StartUpRequest& request, int threads,
                        Solver solver) {
  check(request, kMostBoxShear);
  const Scene scene =
      solver == Solver::kMpm ? shear_box_scene(law, request) : particle_shear_box_scene(law, request);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  StartUp out;
  out.rate = request.rate;
  const auto steps = static_cast<int>(request.steps);
  for (int i = 0; i <= steps; ++i) {
    run_to(*simulation, i);
    out.t.push_back(request.time * i / steps);
    out.stress.push_back(middle_stress(*simulation, middle_half(scene)));
  }
  return out;
}

}  // namespace lather::study
