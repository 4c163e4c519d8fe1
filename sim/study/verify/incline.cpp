// An elastic block on a frictional plane, gravity tilted by theta. Above the friction angle (tan theta >
// mu_f) it slides with a = g (sin theta - mu_f cos theta); below it stays.
//
// The block starts without its weight's compression. Left to itself it would bounce for long, and near the
// friction angle a bouncing block creeps or lags: each landing can stop it, each flight lets it go. Transfer
// is by PIC (flip_blend 0), whose viscosity of some 0.2 m^2/s damps the bounce within 0.04 s and leaves the
// motion as a whole alone; measured is what happens after 0.5 s.

#include "sim/study/verify/incline.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

constexpr double kGravity = 9.81;  // m/s^2
constexpr double kFriction = 0.5;  // of the plane: its angle is 26.57 degrees
constexpr double kTime = 1;        // s
constexpr int kSettled = 5;        // frame, of 10
constexpr double kSpan = 0.5;      // s, from there on

Scene incline_scene(double slope_deg) {
  const double h = 0.02;
  const double angle = slope_deg * std::numbers::pi / 180;
  Scene scene;
  scene.name = "block on an incline";
  scene.dimension = 2;
  scene.domain.box = {Vec3(-0.2, -0.1, 0), Vec3(2.2, 0.3, 0)};
  scene.domain.boundary = Boundary::kOpen;
  scene.gravity = kGravity * Vec3(std::sin(angle), -std::cos(angle), 0);
  scene.spacing = h;
  scene.points_per_cell = 4;
  scene.materials.push_back(
      material_of(HerschelBulkleyParameters{1000, 1e5, 5e4, std::numeric_limits<double>::infinity(), 0, 1}));
  scene.bodies.push_back(body_of(scene, box_at(Vec3(0.1, 0.05, 0), Vec3(0.2, 0.1, 1))));
  Obstacle plane;
  plane.name = "plane";
  plane.shape = box_at(Vec3(1, -0.25 - 1e-3, 0), Vec3(10, 0.5, 1));
  plane.friction = kFriction;
  scene.obstacles.push_back(plane);
  scene.numerics.flip_blend = 0;
  scene.numerics.precision = Precision::kDouble;
  set_frames(scene, kTime, 10);
  return scene;
}

/// From the settled frame to the last.
struct Slide {
  double distance = 0;      ///< m
  double acceleration = 0;  ///< mean, m/s^2
};

Slide slide(double slope_deg, int threads) {
  const Scene scene = incline_scene(slope_deg);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  run_to(*simulation, kSettled);
  const FrameMeasure first = simulation->report().frames.back();
  run_to(*simulation, scene.last_frame());
  const FrameMeasure& last = simulation->report().frames.back();
  return {last.center_of_mass.x() - first.center_of_mass.x(),
          (last.momentum.x() - first.momentum.x()) / last.mass / kSpan};
}

double acceleration(double slope_deg) {
  const double angle = slope_deg * std::numbers::pi / 180;
  return kGravity * (std::sin(angle) - kFriction * std::cos(angle));
}

}  // namespace

std::vector<Finding> verify_incline(int threads) {
  // Coulomb's law is imposed node by node with each node's own normal impulse, so it holds exactly for the
  // whole while all nodes slide one way; what is left of the bounce after twelve of its decay times is
  // nothing.
  std::vector<Finding> findings;
  for (const double slope : {30.0, 40.0})
    findings.push_back({"acceleration at " + std::to_string(static_cast<int>(slope)) + " degrees, relative",
                        std::abs(slide(slope, threads).acceleration / acceleration(slope) - 1), 0.02});
  findings.push_back({"distance at 22 degrees, over the slide at 30 degrees",
                      std::abs(slide(22, threads).distance) / (0.5 * acceleration(30) * kSpan * kSpan),
                      1e-3});
  return findings;
}

}  // namespace lather::study
