#include "tests/scenes/smore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

// Geometry of scenes/smore.json, m.
struct Hole {
  double x;
  double z;
  double radius;
};
// The first is the middle one, which a bar parts into two openings.
constexpr std::array<Hole, 5> kHoles = {{{0, 0, 0.014},
                                         {0.026, 0.026, 0.007},
                                         {-0.026, 0.026, 0.007},
                                         {0.026, -0.026, 0.007},
                                         {-0.026, -0.026, 0.007}}};
constexpr double kHalfCracker = 0.003;
constexpr double kFullPress = 0.0385;                   // height of the cracker's middle
constexpr double kPressed = kFullPress - kHalfCracker;  // the plane to which it presses the foam
constexpr double kRim = 0.030;          // from the axis: beyond lies only foam that was pressed out
constexpr double kFullyPressed = 0.30;  // s
constexpr double kLifted = 0.67;        // s

// The foam fills the holes and rises by 5 mm (one spacing of the preview) over the middle one, and over the
// rims of all others, for 0.06 s: most of the time that the cracker rests.
constexpr double kBulge = 0.005;     // m
constexpr double kBulgeTime = 0.06;  // s
// One neck: when the cracker has been lifted by four times the depth of foam that it had left, all foam
// halfway between the pressed plane and the cracker lies nearer to the axis than the rim of the middle hole,
// by which it is pulled. It hangs together there, or has just torn.
constexpr double kDepth = 0.010;
constexpr double kNeckLift = 4 * kDepth;
constexpr double kNeckRadius = 0.014;
// It tears: after the lift there are two parts. A part holds 2 % of the points or more.
constexpr double kPart = 0.02;
// The peak: from the end of the lift on, 0.4 s, its tip is 15 mm over the pressed plane (half as much again
// as the foam there is deep), and by that depth over all that lies beside it.
constexpr double kOverPress = 0.015;
constexpr double kOverRest = kDepth;

/// Height of the foam over the top face of the cracker in each hole, m.
std::array<double, 5> bulges(const Simulation& simulation, double top_face) {
  std::array<double, 5> over;
  over.fill(kNone);
  simulation.visit_points([&](const PointState& p) {
    for (std::size_t k = 0; k < kHoles.size(); ++k)
      if (std::hypot(p.position.x() - kHoles[k].x, p.position.z() - kHoles[k].z) < kHoles[k].radius)
        over[k] = std::max(over[k], p.position.y() - top_face);
  });
  return over;
}

/// The largest connected part of the foam: its tip, and the highest point beyond the rim, m.
struct Peak {
  double tip = kNone;
  double rest = kNone;
};

Peak find_peak(const Clusters& c) {
  Peak peak;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (c.cluster[i] != 0) continue;
    const Vec3& x = c.points[i].position;
    peak.tip = std::max(peak.tip, x.y());
    if (std::hypot(x.x(), x.z()) > kRim) peak.rest = std::max(peak.rest, x.y());
  }
  return peak;
}

/// Farthest that foam lies from the axis in a layer of one spacing around `height`, m.
double radius_at(const Clusters& c, double height, double spacing) {
  double radius = 0;
  for (const PointState& p : c.points)
    if (std::abs(p.position.y() - height) < spacing / 2)
      radius = std::max(radius, std::hypot(p.position.x(), p.position.z()));
  return radius;
}

}  // namespace

void expect_foam_through_holes_and_a_peak(const Scene& scene, int threads) {
  const Obstacle& cracker = scene.obstacles.back();
  ASSERT_EQ(cracker.name, "upper cracker");
  double bulging = 0;       // s
  bool necked = false;      // the neck has been measured
  double least_second = 1;  // share of the second largest part, over all frames after the lift
  Peak least;               // likewise
  least.tip = std::numeric_limits<double>::infinity();
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    const double t = frame / scene.frame_rate;
    const double middle = pose_at(cracker.motion, t).translation.y();
    if (middle < kFullPress + 0.005) {  // around full press
      const std::array<double, 5> over = bulges(simulation, middle + kHalfCracker);
      if (over[0] >= kBulge && *std::min_element(over.begin(), over.end()) > 0)
        bulging += 1 / scene.frame_rate;
      std::printf("  %.3f s: over the holes %.1f, %.1f, %.1f, %.1f, %.1f mm\n", t, 1e3 * over[0],
                  1e3 * over[1], 1e3 * over[2], 1e3 * over[3], 1e3 * over[4]);
    }
    if (t < kFullyPressed || middle < kFullPress + kNeckLift) return;
    const Clusters c = find_clusters(simulation, scene.spacing);
    if (!necked) {
      necked = true;
      const double radius = radius_at(c, (kPressed + middle - kHalfCracker) / 2, scene.spacing);
      std::printf("  %.3f s: neck of %.1f mm in radius, %.2f %% of the foam in the second part\n", t,
                  1e3 * radius, 100 * c.share(1));
      EXPECT_GT(radius, 0);
      EXPECT_LT(radius, kNeckRadius);
    }
    if (t < kLifted) return;
    const Peak peak = find_peak(c);
    least.tip = std::min(least.tip, peak.tip);
    least.rest = std::max(least.rest, peak.rest);
    least_second = std::min(least_second, c.share(1));
  });
  std::printf("  peak at least %.1f mm over the pressed plane, %.1f mm over the rest; %.1f %% torn off\n",
              1e3 * (least.tip - kPressed), 1e3 * (least.tip - least.rest), 100 * least_second);
  EXPECT_GE(bulging, kBulgeTime);
  EXPECT_TRUE(necked);
  EXPECT_GE(least_second, kPart);
  EXPECT_GE(least.tip - kPressed, kOverPress);
  EXPECT_GE(least.tip - least.rest, kOverRest);
}

Crust find_crust(const Simulation& simulation) {
  constexpr int kSectors = 72;
  const Frame f = simulation.frame();
  const auto scalar = std::find_if(f.points.scalars.begin(), f.points.scalars.end(),
                                   [](const PointScalar& s) { return s.name == "weak"; });
  EXPECT_NE(scalar, f.points.scalars.end());
  const auto sector = [&](std::size_t p) {
    const double angle = std::atan2(f.points.position[p][2], f.points.position[p][0]);
    return std::clamp(static_cast<int>((angle / M_PI + 1) / 2 * kSectors), 0, kSectors - 1);
  };
  const auto radius = [&](std::size_t p) {
    return std::hypot(f.points.position[p][0], f.points.position[p][2]);
  };
  std::array<float, kSectors> shell_radius{};
  std::array<double, 2> count{};
  Crust crust;
  for (std::size_t p = 0; p < f.points.size(); ++p) {
    ++count[f.points.material[p]];
    if (f.points.material[p] == 0) continue;
    crust.weak += static_cast<double>(scalar->values[p]);
    float& r = shell_radius[sector(p)];
    r = std::max(r, radius(p));
  }
  for (std::size_t p = 0; p < f.points.size(); ++p)
    if (f.points.material[p] == 0 && radius(p) > shell_radius[sector(p)]) ++crust.outside;
  crust.outside /= count[0];
  crust.weak /= count[1];
  return crust;
}

void expect_crust_tears_before_core_flows(Scene scene, int threads) {
  scene.output.scalars = {"weak"};
  double torn = -1;  // s, when 1 % of the shell is weak
  double out = -1;   // s, when 0.1 % of the core is outside, a dozen points of the preview
  double most_outside = 0;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    const double t = frame / scene.frame_rate;
    const Crust crust = find_crust(simulation);
    std::printf("  %.3f s: %.2f %% of the shell weak, %.2f %% of the core outside\n", t, 100 * crust.weak,
                100 * crust.outside);
    if (torn < 0 && crust.weak >= 0.01) torn = t;
    if (out < 0 && crust.outside >= 0.001) out = t;
    most_outside = std::max(most_outside, crust.outside);
  });
  ASSERT_GT(torn, 0);
  // The first crack has to open by the width of a sector before the core shows in it.
  EXPECT_GT(out, torn);
  // It keeps flowing out: ten times what counts as the first of it.
  EXPECT_GT(most_outside, 0.01);
}

}  // namespace lather::testing_support
