#include "tests/scenes/sheared_blob.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// Most interior voids of any frame.
std::int64_t most_voids(const Report& r) {
  std::int64_t most = 0;
  for (const FrameMeasure& f : r.frames) {
    EXPECT_GE(f.interior_voids, 0) << "not searched at frame " << f.frame;
    most = std::max(most, f.interior_voids);
  }
  return most;
}

/// Largest |m(t)/m(0) - 1|.
double mass_drift(const Report& r) {
  double drift = 0;
  for (const FrameMeasure& f : r.frames) drift = std::max(drift, std::abs(f.mass / r.frames[0].mass - 1));
  return drift;
}

Report run_blob(const std::string& size, const std::string& resampling, int threads) {
  Report r = run_scene(scene_file("sheared-blob", size, {{"/numerics/resampling", resampling}}), threads);
  const FrameMeasure& last = r.frames.back();
  std::printf(
      "  resampling %s: at most %lld voids; %llu points in, %llu merged; mass drift %.1e; "
      "momentum: %.1e by resampling, %.1e at the end, of %.1e (mass times plate speed)\n",
      resampling.c_str(), static_cast<long long>(most_voids(r)),
      static_cast<unsigned long long>(last.points_inserted),
      static_cast<unsigned long long>(last.points_merged), mass_drift(r), last.resampling_momentum,
      last.momentum.norm(), last.mass * 0.66);
  return r;
}

}  // namespace

void expect_voids_only_without_resampling(const std::string& size, int threads) {
  const Report without = run_blob(size, "null", threads);
  const Report conserving = run_blob(size, R"({"velocity": "conserving"})", threads);
  const Report interpolated = run_blob(size, R"({"velocity": "interpolated"})", threads);

  EXPECT_GT(most_voids(without), 0);
  EXPECT_EQ(most_voids(conserving), 0);
  EXPECT_EQ(most_voids(interpolated), 0);

  // Shares are sums of exact parts; what is left is the order in which 10^3 to 10^4 masses are added in
  // double precision: at worst as many roundings of 1e-16.
  for (const Report* r : {&without, &conserving, &interpolated}) EXPECT_LT(mass_drift(*r), 1e-12);

  // A new point's velocity is rounded to float: 6e-8 of its momentum, at random over points and time. Were
  // all the foam replaced once at the highest speed and all roundings alike, that would change by less than:
  const FrameMeasure& end = conserving.frames.back();
  EXPECT_LT(end.resampling_momentum, 6e-8 * end.mass * end.max_speed);
  // The paper's rule, velocities from the grid, makes up some momentum with every point.
  EXPECT_GT(interpolated.frames.back().resampling_momentum, 1e3 * end.resampling_momentum);
}

}  // namespace lather::testing_support
