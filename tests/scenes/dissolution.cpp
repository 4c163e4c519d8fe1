#include "tests/scenes/dissolution.h"

#include <gtest/gtest.h>

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

}  // namespace

Dissolution run_dissolution(const std::string& name, const std::string& size, double landed,
                            const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file(name, size, overrides);
  Dissolution d;
  bool has_landed = false;
  double covered = 0;
  const Report report = run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    d.dry_last = dry_share(simulation);
    if (frame == scene.last_frame()) covered = covered_volume(scene, simulation, scene.domain.box);
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
  const double weight = compression_under_weight(scene, last.rest_volume / floor_area(scene));
  d.volume_error = covered / (last.rest_volume * (1 - weight)) - 1;
  std::printf("  component's mass %.1e off; powder floats by %.2f, then %.2f of it dry, %.2f at the end\n",
              d.component_drift, d.floating, d.dry_first, d.dry_last);
  std::printf("  volume at rest down by %.4f, by %.4f when mixed; the points cover %+.4f more\n", d.shrinkage,
              d.full_shrinkage, d.volume_error);
  return d;
}

// Flows are added up in single precision, in some thousand steps: the errors of 6e-8 of a flow each make up
// far less than 1e-7 of the sum.
void expect_powder_keeps_its_masses(const std::string& size, double lost, int threads) {
  const std::vector<Override> unbalanced = {{"/numerics/mlsrk/phases/balance", "\"concentration\""}};
  const Dissolution kept = run_dissolution("dissolving-powder-2d", size, 0.4, {}, threads);
  EXPECT_LT(kept.component_drift, 1e-7);
  EXPECT_GT(kept.shrinkage, 0.1);
  EXPECT_GT(run_dissolution("dissolving-powder-2d", size, 0.4, unbalanced, threads).component_drift, lost);
}

void expect_starch_floats_and_dissolves(const std::string& size, double volume_error, int threads) {
  const Dissolution d = run_dissolution("starch", size, 0.1, {}, threads);
  EXPECT_GT(d.floating, 0.5);
  EXPECT_GT(d.dry_first, 0.5);
  EXPECT_EQ(d.dry_last, 0);
  // The paste is of one concentration to a few per cent by then.
  EXPECT_NEAR(d.shrinkage, d.full_shrinkage, 0.05 * d.full_shrinkage);
  EXPECT_NEAR(d.volume_error, 0, volume_error);
}

}  // namespace lather::testing_support
