// The qualities of scenes are what the rule picks from what docs/tradeoff.json measured, and what they
// promise holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "sim/scene/quality.h"
#include "sim/study/scene_parts.h"
#include "sim/study/tradeoff/tradeoff.h"

namespace lather::study {
namespace {

/// What was measured of the solver's exact cases.
std::vector<TradeResult> measured(const std::string& solver) {
  std::ifstream file(LATHER_SOURCE_DIR "/docs/tradeoff.json");
  const Value json = parse_json(std::string(std::istreambuf_iterator<char>(file), {}));
  std::vector<TradeResult> results;
  for (const Value& subject : *json.find("qualities")->find("subjects")->array())
    if (*subject.find("solver")->text() == solver) results.push_back(read_trade_result(subject));
  return results;
}

/// A scene of the solver with default numerics.
Scene plain_scene(Solver solver) {
  Scene scene = particle_scene("plain", 0.1, NeoHookeanParameters{{1000, 1e5, 0.3}, {}});
  scene.solver = solver;
  scene.points_per_cell = solver == Solver::kMpm ? 4 : 1;
  scene.domain.box = {Vec3::Zero(), Vec3(1, 1, 0)};
  scene.bodies.push_back(body_of(scene, box_at(Vec3(0.5, 0.5, 0), Vec3(0.4, 0.4, 1))));
  scene.duration = 1;
  scene.numerics = Numerics{};
  return scene;
}

std::string numerics_text(const Scene& scene) {
  return write_json(*parse_json(to_json(scene)).find("numerics"));
}

class QualityPoints : public testing::TestWithParam<Solver> {
 protected:
  [[nodiscard]] static std::string solver_name() { return GetParam() == Solver::kMpm ? "mpm" : "mlsrk"; }
  const std::vector<MeanPoint> means_ = mean_points(measured(solver_name()));

  /// The measured point with the numerics of that quality.
  [[nodiscard]] const MeanPoint& point_of(const QualityPoint& quality) const {
    const Scene plain = plain_scene(GetParam());
    const std::string wanted = numerics_text(with_quality(plain, quality.quality));
    for (const MeanPoint& m : means_)
      if (numerics_text(with_settings(plain, m.settings)) == wanted) return m;
    throw std::logic_error(std::string(quality.name) + " was not measured");
  }
};

TEST_P(QualityPoints, AreThoseThatTheRulePicks) {
  std::vector<FrontPoint> points;
  for (const MeanPoint& m : means_) points.push_back(m.factor);
  const auto picks = pick_qualities(points, points.at(0));
  ASSERT_TRUE(picks);
  const std::size_t wanted[] = {picks->draft, picks->standard, picks->fine, picks->reference};
  for (std::size_t i = 0; i < 4; ++i) {
    const QualityPoint& quality = quality_points(GetParam())[i];
    EXPECT_EQ(to_text(point_of(quality).settings), to_text(means_.at(wanted[i]).settings)) << quality.name;
  }
}

TEST_P(QualityPoints, AreDominatedByNoOtherMeasuredPoint) {
  for (const QualityPoint& quality : quality_points(GetParam()))
    for (const MeanPoint& other : means_)
      EXPECT_FALSE(dominated(point_of(quality).factor, other.factor))
          << quality.name << " by " << to_text(other.settings);
}

TEST_P(QualityPoints, HaveTheFiguresThatWereMeasured) {
  for (const QualityPoint& quality : quality_points(GetParam())) {
    const MeanPoint& point = point_of(quality);
    // Written with four digits.
    EXPECT_NEAR(quality.error_factor, point.factor.error, 1e-3 * point.factor.error) << quality.name;
    EXPECT_NEAR(quality.cost_factor, point.factor.cost, 1e-3 * point.factor.cost) << quality.name;
  }
}

// What a budget of an error promises. Another kernel level rounds otherwise, which counts as equal.
TEST_P(QualityPoints, KeepTheirErrorOnEveryExactCase) {
  for (const QualityPoint& quality : quality_points(GetParam())) {
    double largest = 0;
    for (const Subject& subject : exact_subjects()) {
      if (subject.scene({}).solver != GetParam()) continue;
      const TradeResult result = run_tradeoff(subject, {point_of(quality).settings}, {1, 1, 0, {}});
      EXPECT_EQ(result.points.front().failure, "") << subject.name;
      largest = std::max(largest, result.points.front().error);
    }
    EXPECT_NEAR(largest, quality.error, kEqualErrors * quality.error) << quality.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, QualityPoints, testing::Values(Solver::kMpm, Solver::kMlsrk),
                         [](const auto& test) {
                           return std::string(test.param == Solver::kMpm ? "mpm" : "mlsrk");
                         });

}  // namespace
}  // namespace lather::study
