#include "tests/scenes/dollop.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

constexpr double kPart = 0.02;     // share of the points that a part holds at least
constexpr double kLasting = 0.03;  // s that parts stay apart: the spoon rises by a cell or two meanwhile

// Frames are 4 ms apart, so that the times of separation are told apart.
Scene dollop(const std::string& size, std::vector<Override> overrides) {
  overrides.push_back({"/frame_rate", "250"});
  return scene_file("pulled-dollop", size, overrides);
}

Pull pull(const char* name, const Scene& scene, int threads, double until = 1e30) {
  Pull p = pull_dollop(scene, threads, kLasting, until);
  std::printf("  %-8s in two parts from %.3f s on; %.0f s of computing to %.3f s, %llu steps of %.3g s\n",
              name, p.separated.value_or(-1), p.report.wall_seconds, p.report.simulated_time,
              static_cast<unsigned long long>(p.report.steps), p.report.largest_time_step);
  std::fflush(stdout);
  return p;
}

}  // namespace

Pull pull_dollop(const Scene& scene, int threads, double lasting, double until) {
  Pull p;
  const auto simulation = Simulation::create(make_plan(scene), threads);
  for (int i = 0; i <= scene.last_frame(); ++i) {
    simulation->step_to_frame(i, [](const Progress&) { return true; });
    const double time = simulation->report().simulated_time;
    if (find_clusters(*simulation, scene.spacing).share(1) < kPart)
      p.separated.reset();
    else if (!p.separated)
      p.separated = time;
    if (time >= until || (p.separated && time >= *p.separated + lasting)) break;
  }
  p.report = simulation->report();
  return p;
}

void expect_tearing_parts_what_else_stays_connected(const std::string& size, int threads,
                                                    const std::vector<std::vector<Override>>& variants) {
  double brittle = 0;  // s, sums over the variants
  double sticky = 0;
  double first_sticky = 0;
  const auto scene = [&](std::size_t variant, const char* key, const char* value) {
    std::vector<Override> all = variants[variant];
    all.push_back({std::string("/materials/0/") + key, value});
    return dollop(size, std::move(all));
  };
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const std::optional<double> one = pull("brittle", scene(v, "recovery_time", "100"), threads).separated;
    const std::optional<double> other = pull("sticky", scene(v, "recovery_time", "0.35"), threads).separated;
    ASSERT_TRUE(one && other);
    brittle += *one;
    sticky += *other;
    if (v == 0) first_sticky = *other;
  }
  // Bonds that recover while the neck thins make it tear later.
  EXPECT_LT(brittle, sticky);
  // All are pulled alike, so an equal time is an equal stretch.
  const Pull untorn =
      pull("untorn", scene(0, "tear_threshold", R"("infinity")"), threads, first_sticky + kLasting);
  EXPECT_GT(untorn.separated.value_or(1e30), first_sticky);
}

void expect_removal_takes_little(const std::string& size, int threads, std::vector<Override> overrides) {
  overrides.push_back({"/numerics/subgrid_removal", "{}"});
  const Scene scene = dollop(size, std::move(overrides));
  const Report r = run_scene(scene, threads);
  const double removed = r.frames.back().mass_removed / r.frames.front().mass;
  std::printf("  removed: %llu points, %.4f %% of the mass\n",
              static_cast<unsigned long long>(r.frames.back().points_removed), 100 * removed);
  EXPECT_GT(removed, 0);
  EXPECT_LT(removed, 0.0028);
}

}  // namespace lather::testing_support
