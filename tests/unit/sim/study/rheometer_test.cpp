// The virtual rheometer: curves against references, and what it refuses.

#include "sim/study/rheometer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/error.h"
#include "sim/scene/material_cards.h"
#include "sim/scene/value.h"
#include "sim/study/flow_models.h"
#include "sim/study/rheometer_json.h"
#include "tests/support/reference_data.h"

namespace lather::study {
namespace {

/// Soft enough to be quick, stiff enough for s/mu <= 0.03 at up to 100/s.
HerschelBulkleyParameters stiff_foam(double flow_index) {
  return {77.7, 109e3, 1e5, 31.9, 27.2, flow_index};
}

TEST(Rheometer, StartUpFollowsTheReference) {
  for (const auto& run : testing_support::simple_shear_runs()) {
    const int intervals = static_cast<int>(run.t.size()) - 1;
    const StartUp got = start_up(run.law(), {run.shear_rate, run.t.back(), intervals});
    const double bound = 3e-4 * run.largest_s();  // steps of 1e-4 in shear, first order: see law_test.cpp
    for (std::size_t i = 0; i < run.t.size(); ++i) {
      EXPECT_NEAR(got.stress[i].tau_xy, run.tau_xy[i], bound) << run.name();
      EXPECT_NEAR(got.stress[i].n1, run.n1[i], bound) << run.name();
      EXPECT_NEAR(got.stress[i].s, run.s[i], bound) << run.name();
    }
  }
}

TEST(Rheometer, AFewReadingsAreAsExactAsMany) {
  // Readings do not choose the law's step: the last of 10 is the last of 1000 to the step's error of 3e-4.
  const HerschelBulkleyParameters law = find_material_card("shaving-cream")->parameters;
  const StartUp few = start_up(law, {1, 1, 10});
  const StartUp many = start_up(law, {1, 1, 1000});
  EXPECT_EQ(few.t.size(), 11U);
  EXPECT_EQ(many.t.size(), 1001U);
  EXPECT_NEAR(few.stress.back().tau_xy, many.stress.back().tau_xy, 3e-4 * many.stress.back().s);
}

TEST(Rheometer, FlowCurveIsThePowerLawAtSmallElasticStrain) {
  for (const double flow_index : {0.22, 0.5, 1.0}) {
    const HerschelBulkleyParameters law = stiff_foam(flow_index);
    const PowerLaw power = power_law(law);
    for (const SteadyFlow& flow : flow_curve(law, read_rate_range("0.01:100"))) {
      ASSERT_TRUE(flow.steady);
      ASSERT_LE(flow.stress.s / law.shear_modulus, 0.03);
      // Finite elastic strain e = s/mu changes the stress by some e^2, here at most 1e-3; the law's step of
      // 1e-4 adds as much as its own size.
      const double strain = flow.stress.s / law.shear_modulus;
      EXPECT_NEAR(flow.stress.tau_xy, stress_at(power, flow.rate),
                  (strain * strain + 2e-4) * flow.stress.tau_xy)
          << "h " << flow_index << " at " << flow.rate << "/s";
    }
  }
}

TEST(Rheometer, FlowCurveEndsWhereTheReferenceCurvesEnd) {
  int compared = 0;
  for (const auto& run : testing_support::simple_shear_runs()) {
    const std::size_t last = run.t.size() - 1;
    // Those references that have come to rest: unchanged over their last tenth.
    if (std::abs(run.s[last] - run.s[last - last / 10]) > 1e-7 * run.s[last]) continue;
    const SteadyFlow flow = flow_curve(run.law(), {run.shear_rate, 2 * run.shear_rate, 2}).front();
    EXPECT_NEAR(flow.stress.tau_xy, run.tau_xy[last], 3e-4 * run.s[last]) << run.name();
    EXPECT_NEAR(flow.stress.n1, run.n1[last], 3e-4 * run.s[last]) << run.name();
    ++compared;
  }
  EXPECT_GE(compared, 5);
}

TEST(Rheometer, RatesAreEvenlySpacedInTheirLogarithm) {
  EXPECT_EQ(read_rate_range("0.01:100").count, 21);  // five a decade and both ends
  const RateRange range = read_rate_range("1:16:5");
  const auto curve = flow_curve(stiff_foam(1), range);
  ASSERT_EQ(curve.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(curve[i].rate, std::exp2(static_cast<double>(i)), 1e-12 * curve[i].rate);
}

TEST(Rheometer, RefusesWhatIsNoRange) {
  for (const char* text : {"", "1", "1:", ":1", "2:1", "0:1", "-1:1", "a:b", "1:2:3:4", "1:2:1", "1:2:2.5",
                           "1:2:5000", "1:2x", "1:inf", "1:2:"})
    EXPECT_THROW((void)read_rate_range(text), InputError) << text;
}

TEST(Rheometer, RefusesValuesOutOfRangeAllAtOnce) {
  const HerschelBulkleyParameters law = stiff_foam(1);
  try {
    (void)start_up(law, {-1, 0, 0});
    FAIL() << "took them";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3U);
  }
  EXPECT_THROW((void)start_up(law, {1e6, 1e6, 10}), InputError);
  EXPECT_THROW((void)start_up(law, {std::nan(""), 1, 10}), InputError);
}

TEST(Rheometer, AnElasticMaterialHasNoFlowCurve) {
  HerschelBulkleyParameters law = stiff_foam(1);
  law.yield_stress = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)flow_curve(law, {}), InputError);
  EXPECT_GT(start_up(law, {1, 0.1, 4}).stress.back().tau_xy, 0);
}

std::size_t length(const Value& document, const char* key) {
  const Value* list = document.find(key);
  return list != nullptr && list->array() != nullptr ? list->array()->size() : 0;
}

TEST(Rheometer, StartUpAsJsonHasFourListsOfOneLength) {
  const Value json = parse_json(to_json(start_up(stiff_foam(1), {1, 1, 7})));
  ASSERT_EQ(json.object()->size(), 4U);
  for (const char* key : {"t", "tau_xy", "n1", "s"}) EXPECT_EQ(length(json, key), 8U) << key;
}

TEST(Rheometer, FlowCurveAsJsonHasListsOfOneLength) {
  const HerschelBulkleyParameters law = stiff_foam(0.5);
  const Value json = parse_json(to_json(law, flow_curve(law, {0.1, 10, 3})));
  for (const char* key : {"rate", "tau_xy", "n1", "s", "power_law", "steady"})
    EXPECT_EQ(length(json, key), 3U) << key;
  EXPECT_EQ(json.find("measured"), nullptr);
  const Value beside = parse_json(to_json(law, flow_curve(law, {0.1, 10, 3}), PowerLaw{18, 12, 0.4}));
  EXPECT_EQ(length(beside, "measured"), 3U);
  EXPECT_NE(beside.find("measured_parameters"), nullptr);
  const Value* viscosity = json.find("effective_viscosity");
  ASSERT_NE(viscosity, nullptr);
  for (const char* key : {"herschel_bulkley", "viscoplastic", "bargteil"})
    EXPECT_EQ(length(*viscosity, key), 3U) << key;
}

}  // namespace
}  // namespace lather::study
