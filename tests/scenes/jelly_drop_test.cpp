// The blend of velocities steadies a jelly that drops [MLSRK Figure 4], 1,156 points: the paper's size.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// Share of the kinetic energy in what sets points apart from their neighbours: of their velocities less the
/// mean over all points within one and a half spacings.
double kinetic_noise(const Simulation& simulation, double spacing) {
  std::vector<PointState> points;
  simulation.visit_points([&](const PointState& p) { points.push_back(p); });
  double apart = 0;
  double all = 0;
  for (const PointState& p : points) {
    Vec3 mean = Vec3::Zero();
    int neighbours = 0;
    for (const PointState& q : points) {
      if ((q.position - p.position).squaredNorm() > 2.25 * spacing * spacing) continue;
      mean += q.velocity;
      ++neighbours;
    }
    apart += (p.velocity - mean / neighbours).squaredNorm();
    all += p.velocity.squaredNorm();
  }
  return apart / all;
}

struct Noise {
  double kinetic = 0;  ///< see kinetic_noise()
  double volume = 0;   ///< max J - min J: of the body as a whole the volume changes by a few per cent
};

/// Both averaged over the frames after the first impact at 0.25 s.
Noise noise(const char* blend) {
  const Scene scene = scene_file("jelly-drop-2d", "preview",
                                 {{"/numerics/mlsrk/velocity_blend", blend}, {"/duration", "0.75"}});
  Noise n;
  int frames = 0;
  const Report r = run_scene(scene, 1, [&](int frame, const Simulation& simulation) {
    if (frame / scene.frame_rate < 0.3) return;
    n.kinetic += kinetic_noise(simulation, scene.spacing);
    ++frames;
  });
  for (const FrameMeasure& f : r.frames)
    if (f.time >= 0.3) n.volume += f.max_volume_ratio - f.min_volume_ratio;
  n = {n.kinetic / frames, n.volume / frames};
  std::printf("  blend %s: kinetic noise %.4f, spread of J %.3f\n", blend, n.kinetic, n.volume);
  return n;
}

TEST(JellyDrop, IsNoisyWithoutTheBlendAndCalmWithIt) {
  const Noise none = noise("1");
  const Noise weak = noise("0.95");
  const Noise strong = noise("0.8");
  const Noise whole = noise("0");
  EXPECT_GT(none.kinetic, 3 * weak.kinetic);
  EXPECT_GT(weak.kinetic, strong.kinetic);
  EXPECT_GT(strong.kinetic, whole.kinetic);
  EXPECT_GT(none.volume, 1.5 * weak.volume);
  EXPECT_GT(weak.volume, strong.volume);
  EXPECT_LT(strong.volume, 0.25);
}

std::vector<FrameMeasure> drop(const char* solver) {
  return run_scene(scene_file("jelly-drop-2d", "preview", {{"/solver", solver}, {"/duration", "0.6"}}), 1)
      .frames;
}

// It falls 0.31 m, is squeezed the most at 0.3 s and leaves the ground again after 0.37 s. Until then the
// heights of its middle differ by no more than a spacing or so: on a grid the ground is felt from half a
// point's distance. Later they differ by what the blend of the particles takes from the rebound.
TEST(JellyDrop, LandsAndReboundsAlikeWithBothSolvers) {
  const std::vector<FrameMeasure> particles = drop("mlsrk");
  const std::vector<FrameMeasure> grid = drop("mpm");
  double apart = 0;
  double rebound[2] = {};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (grid[i].time < 0.34)
      apart = std::max(apart, std::abs(particles[i].center_of_mass.y() - grid[i].center_of_mass.y()));
    if (grid[i].time < 0.4) continue;
    rebound[0] = std::max(rebound[0], particles[i].lowest.y());
    rebound[1] = std::max(rebound[1], grid[i].lowest.y());
  }
  std::printf("  heights of the middle differ by %.1f mm; rebounds %.0f and %.0f mm\n", 1e3 * apart,
              1e3 * rebound[0], 1e3 * rebound[1]);
  EXPECT_LT(apart, 0.03);
  EXPECT_GT(rebound[0], 0.1);
  EXPECT_GT(rebound[1], rebound[0]);
}

}  // namespace
}  // namespace lather::testing_support
