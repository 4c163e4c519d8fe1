#include "tests/scenes/wet_paper.h"

#include <algorithm>
#include <cstdio>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

constexpr std::uint32_t kPaper = 0;  // its material
constexpr double kPart = 0.1;        // share of the points that makes a part

Clusters parts_of_paper(const Scene& scene, const Simulation& simulation) {
  return find_clusters(simulation, 1.5 * scene.spacing,
                       [](const PointState& p) { return p.material == kPaper; });
}

/// Mean concentration of the points of the two largest parts that have one of the other within `distance`,
/// less that of all.
double wetness_of_tear(const Clusters& c, double distance) {
  double all = 0;
  double beside = 0;
  double count = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    all += c.points[i].concentration;
    if (c.cluster[i] > 1) continue;
    bool near = false;
    for (std::size_t j = 0; j < c.points.size() && !near; ++j)
      near = c.cluster[j] == 1 - c.cluster[i] &&
             (c.points[i].position - c.points[j].position).squaredNorm() < distance * distance;
    if (!near) continue;
    beside += c.points[i].concentration;
    ++count;
  }
  return count == 0 ? 0 : beside / count - all / static_cast<double>(c.points.size());
}

}  // namespace

TornPaper run_wet_paper(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("wet-paper", size, overrides);
  TornPaper t;
  t.tear_time = scene.duration;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    const Clusters c = parts_of_paper(scene, simulation);
    t.second_part = c.share(1);
    const double time = frame / scene.frame_rate;
    if (t.second_part < kPart || time >= t.tear_time) return;
    t.tear_time = time;
    t.wetness = wetness_of_tear(c, 3 * scene.spacing);
  });
  std::printf("  parts at %.3f s, wetter by %.3f beside the tear; second part at the end: %.3f\n",
              t.tear_time, t.wetness, t.second_part);
  return t;
}

}  // namespace lather::testing_support
