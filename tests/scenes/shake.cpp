#include "tests/scenes/shake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sim/report/pieces.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {

std::vector<Override> perfectly_plastic(const Scene& scene) {
  const HerschelBulkleyParameters& p = scene.materials.front().herschel_bulkley();
  const double yield = p.yield_stress + std::sqrt(1.5) * p.viscosity * std::pow(kMatchedFlow, p.flow_index);
  return {{"/materials/0/yield_stress", std::to_string(yield)}, {"/materials/0/viscosity", "0"}};
}

std::vector<Override> viscoplastic(const Scene& scene) {
  const HerschelBulkleyParameters& p = scene.materials.front().herschel_bulkley();
  const double viscosity = p.viscosity * std::pow(kMatchedFlow, p.flow_index - 1);
  return {{"/materials/0/viscosity", std::to_string(viscosity)}, {"/materials/0/flow_index", "1"}};
}

Shake shake(const std::string& size, double duration, std::vector<Override> overrides, int threads) {
  overrides.push_back({"/duration", std::to_string(duration)});
  overrides.push_back({"/frame_rate", "60"});
  overrides.push_back({"/numerics/time_step", "0"});
  Shake out;
  out.report = run_scene(scene_file("shaving-cream-shake", size, overrides), threads);
  out.tear_time =
      tear_time(out.report.frames, kTornPiece, kTornFor).value_or(std::numeric_limits<double>::infinity());
  std::printf("tears at %.3f s\n", out.tear_time);
  std::fflush(stdout);
  return out;
}

Held held(const Report& report) {
  Held worst;
  const FrameMeasure& first = report.frames.front();
  worst.fewest_interior_nodes = first.interior_nodes;
  for (const FrameMeasure& f : report.frames) {
    worst.density_off = std::max(worst.density_off, std::abs(f.density_mean - 1));
    worst.least_within_5_percent = std::min(worst.least_within_5_percent, f.density_within_5_percent);
    worst.fewest_interior_nodes = std::min(worst.fewest_interior_nodes, f.interior_nodes);
    worst.skin_off =
        std::max(worst.skin_off, std::abs(f.skin_volume.value() / first.skin_volume.value() - 1));
  }
  std::printf(
      "interior density off by %.2f %%, %.1f %% of %llu nodes or more within 5 %%, skin volume off by %.2f "
      "%%\n",
      100 * worst.density_off, 100 * worst.least_within_5_percent,
      static_cast<unsigned long long>(worst.fewest_interior_nodes), 100 * worst.skin_off);
  std::fflush(stdout);
  return worst;
}

}  // namespace lather::testing_support
