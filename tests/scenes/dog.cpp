#include "tests/scenes/dog.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

constexpr std::uint32_t kHair = 0;  // index of the material

/// The cylinder about the x axis that the hairs reach.
struct Reach {
  double radius = 0;
  double low = 1e30;
  double high = -1e30;

  void include(const Vec3& x) {
    radius = std::max(radius, std::hypot(x.y(), x.z()));
    low = std::min(low, x.x());
    high = std::max(high, x.x());
  }
  [[nodiscard]] bool holds(const Vec3& x) const {
    return std::hypot(x.y(), x.z()) < radius && x.x() > low && x.x() < high;
  }
};

}  // namespace

ShakeOff run_shake_off(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("pseudo-dog", size, overrides);
  Reach reach;
  double water = 0;
  ShakeOff shake;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    double near = 0;
    simulation.visit_points([&](const PointState& p) {
      if (frame == 0 && p.material == kHair) reach.include(p.position);
      if (frame == 0 && p.material != kHair) ++water;
      near += p.material != kHair && reach.holds(p.position) ? 1 : 0;
    });
    shake.wet = near / water;
    shake.wettest = std::max(shake.wettest, shake.wet);
    if (frame < scene.last_frame()) return;
    const Clusters hair =
        find_clusters(simulation, 2 * scene.spacing, [](const PointState& p) { return p.material == kHair; });
    shake.lost = hair.points.size() - hair.sizes.front();
  });
  std::printf("  of the water %.3f at most and %.3f at the end among the hairs, %zu points of hairs lost\n",
              shake.wettest, shake.wet, shake.lost);
  return shake;
}

}  // namespace lather::testing_support
