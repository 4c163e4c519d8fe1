#include "tests/scenes/separation.h"

#include <array>
#include <cstdio>

#include "tests/scenes/coverage.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {

double separation_index(const Scene& scene, const Simulation& simulation) {
  std::array<double, 2> height{};
  std::array<double, 2> points{};
  simulation.visit_points([&](const PointState& p) {
    height[p.material] += p.position.y();
    ++points[p.material];
  });
  // Layers of depths h_1 and h_2 have their middles (h_1 + h_2) / 2 apart.
  const double depth = (points[0] + points[1]) * scene.point_volume() / floor_area(scene);
  return (height[1] / points[1] - height[0] / points[0]) / (depth / 2);
}

Separation run_separation(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("mixture-dam-break", size, overrides);
  std::array<double, 3> sums{};
  std::array<int, 3> frames{};
  const Report report = run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    const double index = separation_index(scene, simulation);
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = static_cast<double>(k) * 0.5 * (scene.duration - 0.5);
      const double time = frame / scene.frame_rate;
      if (time < from || time > from + 0.5) continue;
      sums[k] += index;
      ++frames[k];
    }
  });
  const Separation s = {sums[0] / frames[0], sums[1] / frames[1], sums[2] / frames[2], report.wall_seconds,
                        report.frames.front().points};
  std::printf("  separation index: %.3f, %.3f, %.3f\n", s.start, s.middle, s.end);
  return s;
}

ComparedSeparation compare_separations(const std::string& size, double duration, double finer_step,
                                       int threads) {
  const std::vector<Override> particles = {{"/duration", std::to_string(duration)}};
  std::vector<Override> equal_nodes = particles;
  equal_nodes.push_back({"/solver", "mpm"});
  std::vector<Override> equal_points = equal_nodes;
  // A grid's spacing is the width of its cells, which hold two points an axis.
  equal_points.push_back({"/spacing", std::to_string(2 * scene_file("mixture-dam-break", size).spacing)});
  equal_nodes.push_back({"/numerics/time_step", std::to_string(finer_step)});
  return {run_separation(size, particles, threads), run_separation(size, equal_points, threads),
          run_separation(size, equal_nodes, threads)};
}

}  // namespace lather::testing_support
