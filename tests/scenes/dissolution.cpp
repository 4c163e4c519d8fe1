#include "tests/scenes/dissolution.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/scenes/coverage.h"
#include "tests/scenes/scene_run.h"
#include "tests/scenes/separation.h"

namespace lather::testing_support {
namespace {

constexpr double kWater = 0.3;        // points with more count as water in the paper
constexpr std::uint32_t kPowder = 1;  // its material

double dry_share(const Simulation& simulation) {
  double dry = 0;
  double all = 0;
  simulation.visit_points([&](const PointState& p) {
    if (p.material != kPowder) return;
    ++all;
    if (p.concentration < kWater) ++dry;
  });
  return dry / all;
}

/// The domain, up to where its walls end.
Box3 tank_of(const Scene& scene) {
  Box3 tank = scene.domain.box;
  if (scene.dimension == 2) tank.min.z() = tank.max.z() = 0;
  return tank;
}

}  // namespace

Dissolution run_dissolution(const std::string& name, const std::string& size, double landed,
                            const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file(name, size, overrides);
  Dissolution d;
  bool has_landed = false;
  const Box3 tank = tank_of(scene);
  const Report report = run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    d.dry_last = dry_share(simulation);
    d.volume_error = covered_volume(scene, simulation, tank);
    if (has_landed || frame / scene.frame_rate < landed) return;
    has_landed = true;
    d.floating = separation_index(scene, simulation);
    d.dry_first = d.dry_last;
  });
  const PhaseMeasure& first = *report.frames.front().phases;
  const PhaseMeasure& last = *report.frames.back().phases;
  for (const FrameMeasure& f : report.frames)
    d.component_drift =
        std::max(d.component_drift, std::abs(f.phases->component_mass / first.component_mass - 1));
  const double mass = report.frames.front().mass;
  const double mixed =
      mass / value_at(*scene.materials[kPowder].phase->curve_of("density"), first.component_mass / mass);
  d.shrinkage = 1 - last.rest_volume / first.rest_volume;
  d.full_shrinkage = 1 - mixed / first.rest_volume;
  const Vec3 across = tank.extent();
  const double depth = last.rest_volume / (across.x() * (scene.dimension == 3 ? across.z() : 1));
  d.volume_error /= last.rest_volume * (1 - compression_under_weight(scene, depth));
  d.volume_error -= 1;
  std::printf(
      "  component's mass %.1e off; powder floats by %.2f, then %.2f of it dry, %.2f at the end; volume at "
      "rest "
      "down by %.4f, by %.4f when mixed; the points cover %+.4f more\n",
      d.component_drift, d.floating, d.dry_first, d.dry_last, d.shrinkage, d.full_shrinkage, d.volume_error);
  return d;
}

}  // namespace lather::testing_support
