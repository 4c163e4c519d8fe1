// A cylinder of height H collapses slowly under its weight; tau' = tau_y/(rho g H). For tau' around 0.1 it
// slumps by s' = 1 - sqrt(3) tau' (1 - ln(sqrt(3) tau')) of its height (Pashias et al. 1996, with von Mises'
// uniaxial yield sqrt(3) tau_y in place of Tresca's 2 tau_y). The model lets horizontal sections widen
// freely, so the floor has no friction, and it neglects all but the vertical stress.
//
// A quarter of the cylinder between slip walls. The fluid is Bingham's with a viscosity K = rho g H
// sqrt(H/g), high enough that inertia carries nothing over. Such a fluid comes to rest slowly: the slump was
// 0.462 after 3 s, 0.484 after 4 s, 0.496 after 5 s and 0.503 after 6 s at tau' = 0.1, where the model says
// 0.523.

#include "sim/study/verify/slump.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/study/flow_models.h"
#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

constexpr double kHeight = 0.1;  // H and the radius, m
constexpr double kDensity = 1000;
constexpr double kGravity = 9.81;
constexpr double kWeight = kDensity * kGravity * kHeight;  // Pa

Scene slump_scene(double yield_ratio) {
  const double h = kHeight / 10;
  HerschelBulkleyParameters law;
  law.density = kDensity;
  law.shear_modulus = 20 * kWeight;
  law.bulk_modulus = 50 * kWeight;
  set_flow(law, {yield_ratio * kWeight, kWeight * std::sqrt(kHeight / kGravity), 1});
  Scene scene;
  scene.name = "slump of a cylinder";
  scene.domain.box = {Vec3::Zero(), Vec3(2.4, 1.2, 2.4) * kHeight};
  scene.spacing = h;
  scene.points_per_cell = 8;
  scene.materials.push_back(material_of(law));
  const auto cylinder = std::make_shared<const Shape>(Shape{CylinderShape{kHeight, 2 * kHeight, 0}});
  scene.bodies.push_back(body_of(scene, cylinder));
  scene.numerics.transfer = Transfer::kApic;
  set_frames(scene, 6, 1);
  return scene;
}

/// Share of the height that is lost; the highest point stands half a point's distance under the surface.
double slump(double yield_ratio, int threads) {
  const Scene scene = slump_scene(yield_ratio);
  const auto simulation = Simulation::create(make_plan(scene), threads);
  run_to(*simulation, scene.last_frame());
  return 1 - (simulation->report().frames.back().highest.y() + 0.25 * scene.spacing) / kHeight;
}

}  // namespace

std::vector<Finding> verify_slump(int threads) {
  std::vector<Finding> findings;
  for (const double yield_ratio : {0.1, 0.15}) {
    const double t = std::sqrt(3.0) * yield_ratio;
    const double theory = 1 - t * (1 - std::log(t));
    const double got = slump(yield_ratio, threads);
    char what[96];
    std::snprintf(what, sizeof what, "slump at tau' = %.2f: %.3f of the height, theory %.3f", yield_ratio,
                  got, theory);
    // Half a cell of ten, as the height is known no better.
    findings.push_back({what, std::abs(got - theory), 0.05});
  }
  return findings;
}

}  // namespace lather::study
