// Speed against accuracy: the table of knobs, which points dominate, and what a measurement says.

#include "sim/study/tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "sim/error.h"
#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

const Subject& subject_named(const std::string& name) {
  for (const Subject& s : exact_subjects())
    if (s.name == name) return s;
  throw std::logic_error("no case " + name);
}

Setting setting(const std::string& knob, Value value) {
  const Knob& k = knob_named(knob);
  return {k.name, k.pointer, k.turn, std::move(value)};
}

/// A foam that falls on the floor, with resampling, in 2D.
Scene falling_foam() {
  return parse_scene(R"({"lather": 1, "name": "foam", "dimension": 2, "duration": 0.02, "frame_rate": 200,
    "spacing": 0.01, "domain": {"min": [0, 0], "max": [0.2, 0.2]}, "numerics": {"resampling": {}},
    "materials": [{"name": "foam", "density": 100, "bulk_modulus": 1e4, "shear_modulus": 1e3, "yield_stress": 10}],
    "bodies": [{"name": "block", "material": "foam", "velocity": [0, -1],
                "shape": {"type": "box", "size": [0.08, 0.08, 1], "translate": [0.1, 0.05]}}]})");
}

FrontPoint point(double error, double cost, double spread = 0) {
  return {error, cost, cost * (1 - spread), cost * (1 + spread)};
}

TEST(Front, DominatedIsWhatAnotherBeatsInBoth) {
  EXPECT_TRUE(dominated(point(2, 2), point(1, 1)));
  EXPECT_TRUE(dominated(point(2, 2), point(2, 1)));
  EXPECT_TRUE(dominated(point(2, 2), point(1, 2)));
  EXPECT_FALSE(dominated(point(2, 2), point(2, 2)));
  EXPECT_FALSE(dominated(point(2, 2), point(1, 3)));
  EXPECT_FALSE(dominated(point(2, 2), point(3, 1)));
}

TEST(Front, NoiseDominatesNothing) {
  EXPECT_FALSE(dominated(point(2, 2, 0.1), point(2, 1.7, 0.1)));  // 1.87 > 1.8: runs overlap
  EXPECT_TRUE(dominated(point(2, 2, 0.1), point(2, 1.6, 0.1)));   // 1.76 < 1.8
  EXPECT_FALSE(dominated(point(2, 2), point(2 * (1 - 0.9 * kEqualErrors), 2)));
  EXPECT_TRUE(dominated(point(2, 2), point(2 * (1 - 1.1 * kEqualErrors), 2)));
  EXPECT_TRUE(dominated(point(2, 2), point(2 * (1 + 0.9 * kEqualErrors), 1)));
  EXPECT_FALSE(dominated(point(2, 2), point(2 * (1 + 1.1 * kEqualErrors), 1)));
}

TEST(Front, WhatFailedNeitherDominatesNorIsOnIt) {
  const FrontPoint failed = {kNan, 1, 1, 1};
  EXPECT_FALSE(dominated(point(2, 2), failed));
  EXPECT_FALSE(dominated(failed, point(2, 0.5)));
  EXPECT_EQ(front_of({point(1, 2), point(2, 1), point(2, 2)}), (std::vector<std::size_t>{1, 0}));
}

TEST(Qualities, ArePickedByTheRule) {
  //                                      0: draft      1: too crude  2: defaults  3: standard   4: fine
  const std::vector<FrontPoint> points = {point(3, 0.4),   point(5, 0.1), point(1, 1),     point(0.8, 0.9),
                                          point(0.5, 2.5), point(0.3, 9), point(0.299, 20)};
  const auto picks = pick_qualities(points, points[2]);
  ASSERT_TRUE(picks);
  EXPECT_EQ(picks->draft, 0U);
  EXPECT_EQ(picks->standard, 3U);
  EXPECT_EQ(picks->fine, 4U);
  EXPECT_EQ(picks->reference, 5U) << "20 times the cost for what is equal";
  EXPECT_FALSE(pick_qualities({point(9, 1)}, point(1, 1)));
}

TEST(Knobs, HaveNamesOfTheirOwnAndTurnSomething) {
  std::set<std::string> names;
  const Scene mpm = falling_foam();
  Scene mlsrk = particle_scene("particles", 0.1, NeoHookeanParameters{{1000, 1e5, 0.3}, {}});
  for (const Knob& knob : knobs()) {
    EXPECT_TRUE(names.insert(knob.name).second) << knob.name;
    EXPECT_FALSE(knob.values.empty()) << knob.name;
    // implicit-step-factor belongs to semi-implicit scenes.
    if (knob.name == "implicit-step-factor") continue;
    EXPECT_TRUE(turns(knob, mpm) || turns(knob, mlsrk)) << knob.name;
    EXPECT_EQ(read_knob(knob.name).pointer, knob.pointer);
  }
}

TEST(Knobs, ChangeTheFieldsTheyPointAt) {
  const Scene scene = falling_foam();
  EXPECT_EQ(with_settings(scene, {setting("kernel", "quadratic")}).numerics.kernel, Kernel::kQuadratic);
  EXPECT_DOUBLE_EQ(with_settings(scene, {setting("spacing", 0.5)}).spacing, 0.005);
  EXPECT_EQ(with_settings(scene, {setting("points-per-cell", 3)}).points_per_cell, 9);
  EXPECT_DOUBLE_EQ(
      with_settings(scene, {setting("bulk-modulus", 0.1)}).materials.front().herschel_bulkley().bulk_modulus,
      1e3);
  EXPECT_FALSE(with_settings(scene, {setting("resampling", nullptr)}).numerics.resampling);
  EXPECT_DOUBLE_EQ(with_settings(scene, {setting("resampling-interval", 5.0)}).numerics.resampling->interval,
                   2.5e-3);
  EXPECT_EQ(to_json(with_settings(scene, {})), to_json(scene));
  EXPECT_THROW(static_cast<void>(with_settings(scene, {setting("kernel", "round")})), InputError);
  EXPECT_THROW(static_cast<void>(with_settings(scene, {setting("spacing", -1.0)})), InputError);
}

TEST(Knobs, AreReadFromText) {
  const Knob knob = read_knob("safety-factor=0.1,0.3");
  ASSERT_EQ(knob.values.size(), 2U);
  EXPECT_EQ(std::get<double>(knob.values[1].data), 0.3);
  EXPECT_EQ(*read_knob("kernel=quadratic").values.front().text(), "quadratic");
  EXPECT_THROW(static_cast<void>(read_knob("kernl")), InputError);
  const std::vector<Knob> two = {knob, read_knob("kernel")};
  EXPECT_EQ(one_at_a_time(two).size(), 5U);
  EXPECT_EQ(product(two).size(), 4U);
}

TEST(Subjects, AreScenesThatCanBeWrittenAndRead) {
  for (const Subject& s : exact_subjects()) {
    SCOPED_TRACE(s.name);
    const Scene scene = s.scene({});
    EXPECT_EQ(to_json(with_settings(scene, {})), to_json(scene));
    EXPECT_EQ(scene.numerics.precision, Precision::kFloat) << "numerics are the defaults";
  }
}

// With APIC alone nothing but the grid adds to the liquid's viscosity, and that of second order in h.
TEST(Tradeoff, MeasuresAnErrorThatFallsWithTheSpacing) {
  TradeRequest request;
  request.repeats = 2;
  const std::vector<Settings> settings = {{setting("transfer", "apic"), setting("spacing", 2.0)},
                                          {setting("transfer", "apic")},
                                          {setting("transfer", "apic")}};
  const TradeResult result = run_tradeoff(subject_named("viscous-wave"), settings, request);
  ASSERT_EQ(result.points.size(), 2U) << "equal scenes stand once";
  for (const TradePoint& p : result.points) {
    EXPECT_EQ(p.failure, "");
    EXPECT_EQ(p.seconds.size(), 2U);
    EXPECT_GT(p.seconds.front(), 0);
    EXPECT_EQ(p.point_steps, p.points * p.steps);
  }
  // Order 2 is a factor of 4; the coarse wave has 8 cells, where higher orders count.
  EXPECT_GT(result.points[0].error, 3 * result.points[1].error);
  EXPECT_EQ(result.points[0].point_steps * 4, result.points[1].point_steps);
}

TEST(Tradeoff, KeepsWhatCannotBeRunWithItsReason) {
  const std::vector<Settings> settings = {{}, {setting("spacing", 2.0)}};
  const TradeResult result = run_tradeoff(subject_named("couette"), settings, {1, 1, 0, {}});
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_EQ(result.points[0].failure, "");
  EXPECT_NE(result.points[1].failure, "");
  EXPECT_TRUE(std::isnan(result.points[1].error));
  EXPECT_FALSE(result.points[0].dominated);
  EXPECT_TRUE(mean_points({result}).size() == 1);
}

TEST(Tradeoff, IsReadAsItWasWritten) {
  const TradeResult result =
      run_tradeoff(subject_named("mlsrk-couette"), {{}, {setting("spacing", 2.0)}}, {1, 1, 0, {}});
  const std::string text = write_json(to_json(result));
  EXPECT_EQ(write_json(to_json(read_trade_result(parse_json(text)))), text);
  EXPECT_THROW(static_cast<void>(read_trade_result(parse_json("{\"name\": \"x\"}"))), InputError);
}

TEST(Tradeoff, OfASceneIsAgainstItsFinestRun) {
  const Scene scene = falling_foam();
  const Subject subject = scene_subject(scene, 1);
  const std::vector<Settings> settings = {
      {}, {setting("spacing", 1.5)}, finest_settings(scene), {setting("frame-rate", 2.0)}};
  const TradeResult result = run_tradeoff(subject, settings, {1, 1, 0, {}});
  EXPECT_EQ(result.points[2].error, 0) << "the finest run is its own reference, bit for bit";
  EXPECT_GT(result.points[0].error, 0);
  EXPECT_GT(result.points[1].error, result.points[0].error);
  EXPECT_LT(result.points[0].error, 0.5);
  EXPECT_EQ(result.points[0].measures.size(), 3U) << "nothing tears";
  EXPECT_EQ(result.points[3].failure, "");
}

TEST(Tradeoff, MeansAreGeometricAndOverTheFirstPoint) {
  TradeResult a;
  a.points.resize(2);
  a.points[0].error = 1;
  a.points[0].seconds = {2};
  a.points[1].settings = {setting("kernel", "quadratic")};
  a.points[1].error = 4;
  a.points[1].seconds = {1, 0.5, 2};
  TradeResult b = a;
  b.points[1].error = 1;
  b.points[1].seconds = {4};
  const std::vector<MeanPoint> means = mean_points({a, b});
  ASSERT_EQ(means.size(), 2U);
  EXPECT_DOUBLE_EQ(means[1].factor.error, 2);
  EXPECT_DOUBLE_EQ(means[1].factor.cost, 1);
  EXPECT_DOUBLE_EQ(means[1].factor.dearest, std::sqrt(2.0));
}

}  // namespace
}  // namespace lather::study
