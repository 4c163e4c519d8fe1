// A viscoelastic block hangs by its top [MLSRK Figure 7], 250 points at 50 mm: the paper's size.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// What a block does that is let go at t = 0.
struct Hanging {
  double sag = 0;         ///< m, of its lowest point, mean over the last half second
  double narrowing = 0;   ///< -log(width) over log(height) of its middle, in the same time
  double swing_left = 0;  ///< momentum in the last third of a second over that in the first, by squares
};

/// Spread of the points in the block's middle along x and y: roots of mean squares.
struct Spread {
  double x = 0;
  double y = 0;
};

class Middle {
 public:
  Spread spread(const Simulation& simulation) {
    Vec3 sum = Vec3::Zero();
    Vec3 squares = Vec3::Zero();
    double count = 0;
    simulation.visit_points([&](const PointState& p) {
      if (first_) chosen_[p.id] = std::abs(p.position.y() - 1) < 0.12;
      if (!chosen_[p.id]) return;
      sum += p.position;
      squares += p.position.cwiseProduct(p.position);
      ++count;
    });
    first_ = false;
    const Vec3 variance = squares / count - (sum / count).cwiseProduct(sum / count);
    return {std::sqrt(variance.x()), std::sqrt(variance.y())};
  }

 private:
  bool first_ = true;
  std::map<std::uint32_t, bool> chosen_;
};

Hanging hang(const std::vector<Override>& overrides) {
  const Scene scene = scene_file("viscoelastic-block", "preview", overrides);
  Middle middle;
  Spread first;
  double widths = 0;
  double heights = 0;
  double lowest = 0;
  int frames = 0;
  const Report r = run_scene(scene, 1, [&](int frame, const Simulation& simulation) {
    const Spread now = middle.spread(simulation);
    if (frame == 0) first = now;
    if (frame / scene.frame_rate < scene.duration - 0.5) return;
    widths += std::log(now.x / first.x);
    heights += std::log(now.y / first.y);
    lowest += simulation.report().frames.back().lowest.y();
    ++frames;
  });
  double early = 0;
  double late = 0;
  for (const FrameMeasure& f : r.frames) {
    const double squared = f.momentum.squaredNorm();
    if (f.time < 0.33) early += squared;
    if (f.time > scene.duration - 0.33) late += squared;
  }
  return {r.frames.front().lowest.y() - lowest / frames, -widths / heights, std::sqrt(late / early)};
}

Hanging with(const char* pointer, const char* value) {
  return hang({{std::string("/materials/0/") + pointer, value}});
}

// Between the held layer and the lowest one lie 9 gaps of d = 50 mm, the k-th from below stretched by the
// weight of k layers, rho g k d: 45 rho g d^2 / E in all. Waves that are left and narrowing take a little.
TEST(ViscoelasticBlock, SagsTheLessTheStifferItIs) {
  double before = 1;
  for (const auto& [modulus, pascals] :
       {std::pair{"6e4", 6e4}, std::pair{"1.2e5", 1.2e5}, std::pair{"2.4e5", 2.4e5}}) {
    const double sag = with("youngs_modulus", modulus).sag;
    const double expected = 45 * 1000 * 9.81 * 0.05 * 0.05 / pascals;
    std::printf("  E = %s Pa: %.2f mm, %.2f mm expected\n", modulus, 1e3 * sag, 1e3 * expected);
    EXPECT_NEAR(sag, expected, 0.03 * expected);
    EXPECT_LT(sag, before);
    before = sag;
  }
}

TEST(ViscoelasticBlock, NarrowsByPoissonsRatio) {
  for (const auto& [ratio, nu] : {std::pair{"0", 0.0}, std::pair{"0.2", 0.2}, std::pair{"0.4", 0.4}}) {
    const double narrowing = with("poisson_ratio", ratio).narrowing;
    std::printf("  nu = %s: %.3f\n", ratio, narrowing);
    EXPECT_NEAR(narrowing, nu, 0.05);
  }
}

// With a Poisson's ratio of 0 the block changes its volume as it stretches.
TEST(ViscoelasticBlock, SwingsTheLessTheMoreViscousItIs) {
  for (const char* viscosity : {"viscosity", "bulk_viscosity"}) {
    double before = 1;
    for (const char* value : {"0", "100", "400"}) {
      const double left =
          hang({{"/materials/0/poisson_ratio", "0"}, {std::string("/materials/0/") + viscosity, value}})
              .swing_left;
      std::printf("  %s = %s Pa s: %.3f of the swing left\n", viscosity, value, left);
      EXPECT_LT(left, 0.9 * before);
      before = left;
    }
  }
}

}  // namespace
}  // namespace lather::testing_support
