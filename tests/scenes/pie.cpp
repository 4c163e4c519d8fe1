#include "tests/scenes/pie.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

const Obstacle& obstacle(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                       [&](const Obstacle& o) { return o.name == name; });
}

/// Which clusters have a point within `reach` (m) of the obstacle.
std::vector<bool> touching(const Clusters& c, const Obstacle& o, double reach) {
  std::vector<bool> touch(c.sizes.size(), false);
  for (std::size_t i = 0; i < c.points.size(); ++i)
    if (!touch[c.cluster[i]] && distance(*o.shape, c.points[i].position) <= reach) touch[c.cluster[i]] = true;
  return touch;
}

}  // namespace

Splat find_splat(const Scene& scene, const Simulation& simulation) {
  const Clusters c = find_clusters(simulation, scene.spacing);
  const std::vector<bool> floor = touching(c, obstacle(scene, "ground"), 2 * scene.spacing);
  const std::vector<bool> face = touching(c, obstacle(scene, "face"), 2 * scene.spacing);
  Splat splat;
  for (std::size_t k = 0; k < c.sizes.size(); ++k)
    (floor[k] ? splat.on_floor : face[k] ? splat.on_face : splat.floating) += c.share(k);
  return splat;
}

void expect_cream_sticks_to_the_face(const std::string& size, const std::vector<Override>& overrides,
                                     int threads) {
  const Scene scene = scene_file("pie-throw", size, overrides);
  const int after_a_second = static_cast<int>(std::lround(scene.frame_rate));
  Splat at_a_second;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    if (frame % 5 != 0) return;
    const Splat s = find_splat(scene, simulation);
    std::printf("  frame %d: on the face %.4f, on the floor %.4f, floating %.4f of the cream\n", frame,
                s.on_face, s.on_floor, s.floating);
    if (frame == after_a_second) at_a_second = s;
  });
  // A third of the pie's disc looks past the face; some of that wraps around it or hangs on by what does.
  EXPECT_GE(at_a_second.on_face, 0.75);
  EXPECT_GT(at_a_second.on_floor, 0);
  // What falls takes 0.2 s from the face's height: by now it lies.
  EXPECT_EQ(at_a_second.floating, 0);
}

}  // namespace lather::testing_support
