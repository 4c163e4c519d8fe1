// The semi-implicit step in the shaken shaving cream, at ten times the longest step that explicit ones bear.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>

#include "sim/report/pieces.h"
#include "sim/simulation.h"

namespace lather {
namespace {

constexpr int kFrameRate = 60;    // 1/s: the tear's time is known to a frame
constexpr double kPiece = 0.1;    // share of the points that the torn-off piece holds at least
constexpr double kLasting = 0.1;  // s that it stays away

/// The whole scene, 2 s, at 6 mm with the FLIP/PIC blend, without resampling or removal, with `steps` equal
/// steps a frame; none where the run fails.
std::optional<Report> shake(const std::string& integration, int steps) {
  std::ifstream file(LATHER_SCENES "/shaving-cream-shake.json");
  std::stringstream text;
  text << file.rdbuf();
  const double step = 1.0 / (kFrameRate * steps);
  const Scene scene = parse_scene(text.str(), "preview",
                                  {{"/duration", "2"},
                                   {"/spacing", "0.006"},
                                   {"/numerics/transfer", "flip"},
                                   {"/numerics/resampling", "null"},
                                   {"/numerics/subgrid_removal", "null"},
                                   {"/frame_rate", std::to_string(kFrameRate)},
                                   {"/numerics/integration", integration},
                                   {"/numerics/time_step", std::to_string(step * (1 + 1e-6))}});
  const auto simulation = Simulation::create(make_plan(scene), 2);
  std::optional<Report> report;
  try {
    for (int i = 0; i <= scene.last_frame(); ++i)
      simulation->step_to_frame(i, [](const Progress&) { return true; });
    report = simulation->report();
  } catch (const SimulationError&) {
  }
  const Report& r = simulation->report();
  const std::optional<double> torn = tear_time(r.frames, kPiece, kLasting);
  std::printf("%-13s step %.3e s, %s %.2f s, tear at %.4f s, %6.1f s of computing, %.1f iterations a step\n",
              integration.c_str(), r.largest_time_step, report ? "lived" : "died after", r.simulated_time,
              torn.value_or(-1), r.wall_seconds,
              r.solver.solves == 0
                  ? 0.0
                  : static_cast<double>(r.solver.iterations) / static_cast<double>(r.solver.solves));
  std::fflush(stdout);
  return report;
}

TEST(SemiImplicitShake, LivesAtTenTimesTheExplicitLimitAndTearsAtTheSameTime) {
  // The step bound is h/c = 160 us, 104 steps a frame.
  int too_few = 104;
  int enough = 260;
  ASSERT_FALSE(shake("explicit", too_few).has_value());
  std::optional<Report> longest = shake("explicit", enough);
  ASSERT_TRUE(longest.has_value());
  while (enough - too_few > enough / 25) {  // to 4 %
    const int middle = (enough + too_few) / 2;
    if (std::optional<Report> r = shake("explicit", middle)) {
      enough = middle;
      longest = r;
    } else {
      too_few = middle;
    }
  }

  const std::optional<Report> r =
      shake("semi-implicit", too_few / 10);  // nothing explicit bears a tenth of it
  ASSERT_TRUE(r.has_value());
  EXPECT_GE(r->largest_time_step, 10 * longest->largest_time_step);
  EXPECT_EQ(r->solver.unconverged, 0U);
  const std::optional<double> expected = tear_time(longest->frames, kPiece, kLasting);
  const std::optional<double> found = tear_time(r->frames, kPiece, kLasting);
  ASSERT_TRUE(expected.has_value());
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found / *expected, 1, 0.1);
}

}  // namespace
}  // namespace lather
