// A column of dry sand of width d and height a d collapses in plane strain along a floor, away from a wall:
// it runs out by 1.2 a d (a < 1.8) and 1.9 a^(2/3) d (a > 2.8), whatever the grains and the floor (Lube,
// Huppert, Sparks and Freundt, "Collapses of two-dimensional granular columns", Phys. Rev. E 72 (2005)
// 041301).
//
// Friction of 30 degrees, matched in plane strain, as their grains have (29 to 31 degrees of repose); floor
// with a coefficient of 0.5, wall without friction, no cohesion, no dilatancy. The front is where 99 % of the
// points lie behind: beyond it single grains slide.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/study/scene_parts.h"
#include "sim/study/verify/mlsrk/cases.h"

namespace lather::study::mlsrk {
namespace {

constexpr double kWidth = 0.1;  // d, m
constexpr double kGravity = 9.81;
constexpr int kPoints = 16;  // across the width
constexpr int kFrames = 12;

Scene column(double aspect) {
  const double h = kWidth / kPoints;
  DruckerPragerParameters sand;
  sand.elastic = {1500, 2.5e5, 0.2};
  sand.friction_angle_deg = 30;
  sand.match = FrictionMatch::kPlaneStrain;
  Scene scene = particle_scene("sand column", h, sand);
  scene.gravity = Vec3(0, -kGravity, 0);
  scene.domain.box = {Vec3::Zero(), Vec3(2 + 2.5 * aspect, 1.5 * aspect + 1, 0) * kWidth};
  scene.bodies.push_back(
      body_of(scene, box_at(Vec3(0.5, 0.5 * aspect, 0) * kWidth, Vec3(kWidth, aspect * kWidth, 1))));
  Obstacle floor;
  floor.name = "floor";
  floor.shape = box_at(Vec3(0, 0.5 * h - 1, 0), Vec3(100, 2, 100));
  floor.friction = 0.5;
  scene.obstacles.push_back(floor);
  // With volumes from neighbours the points at the surface see space above them and bear no pressure, so no
  // friction: this thin deposit then runs out by 14 to 22 % further.
  scene.numerics.mlsrk.volume_correction = false;
  set_frames(scene, 6 * std::sqrt(aspect * kWidth / kGravity), kFrames);
  return scene;
}

/// Over the width.
double run_out(const Simulation& simulation) {
  std::vector<double> places;
  simulation.visit_points([&](const PointState& p) { places.push_back(p.position.x()); });
  std::sort(places.begin(), places.end());
  return places[static_cast<std::size_t>(0.99 * static_cast<double>(places.size()))] / kWidth - 1;
}

Finding finding(double aspect, double expected, int threads) {
  const Scene scene = column(aspect);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  run_to(*simulation, kFrames);
  char name[64];
  std::snprintf(name, sizeof name, "run-out at a = %g, relative", aspect);
  return {name, std::abs(run_out(*simulation) / expected - 1), 0.15};
}

}  // namespace

std::vector<Finding> verify_sand_column(int threads) {
  std::vector<Finding> findings;
  for (const double aspect : {1.0, 1.5}) findings.push_back(finding(aspect, 1.2 * aspect, threads));
  for (const double aspect : {3.0, 5.0})
    findings.push_back(finding(aspect, 1.9 * std::cbrt(aspect * aspect), threads));
  return findings;
}

}  // namespace lather::study::mlsrk
