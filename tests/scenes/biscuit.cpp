#include "tests/scenes/biscuit.h"

#include <cstdio>
#include <map>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

constexpr std::uint32_t kBiscuit = 0;  // its material
constexpr double kWet = 0.2;           // from here on its cohesion is that of wet biscuit
constexpr double kDry = 0.1;
constexpr double kLifted = 1.1;  // s: the hands have come up again
constexpr double kTable = 0.05;  // m: above the water, below the lifted ring

}  // namespace

BrokenBiscuit run_biscuit(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("biscuit", size, overrides);
  std::map<std::uint32_t, double> concentration;  // by id, when it came out
  std::map<std::uint32_t, double> height;         // at the end
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    const bool lifted = frame / scene.frame_rate >= kLifted;
    simulation.visit_points([&](const PointState& p) {
      if (p.material != kBiscuit) return;
      if (lifted) concentration.try_emplace(p.id, p.concentration);
      height[p.id] = p.position.y();
    });
  });
  double wet = 0;
  double wet_fallen = 0;
  double dry = 0;
  double dry_held = 0;
  for (const auto& [id, c] : concentration) {
    const bool fallen = height.at(id) < kTable;
    if (c > kWet) ++wet;
    if (c > kWet && fallen) ++wet_fallen;
    if (c < kDry) ++dry;
    if (c < kDry && !fallen) ++dry_held;
  }
  const BrokenBiscuit b = {wet / static_cast<double>(concentration.size()), wet_fallen / wet, dry_held / dry};
  std::printf("  %.3f of the biscuit is wet; of that %.3f falls; of the dry part %.3f holds\n", b.wet,
              b.wet_fallen, b.dry_held);
  return b;
}

}  // namespace lather::testing_support
