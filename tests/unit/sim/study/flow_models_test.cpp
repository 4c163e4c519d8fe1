// Closed forms of steady flow.

#include "sim/study/flow_models.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/error.h"

namespace lather::study {
namespace {

TEST(FlowModels, AMeasuredFlowCurveComesBackFromItsParameters) {
  HerschelBulkleyParameters law = {77.7, 109e3, 290, 0, 0, 1};
  set_flow(law, {18.4, 12.6, 0.4});
  const PowerLaw back = power_law(law);
  EXPECT_NEAR(back.yield_stress, 18.4, 1e-12);
  EXPECT_NEAR(back.consistency, 12.6, 1e-12);
  EXPECT_EQ(back.flow_index, 0.4);
  EXPECT_EQ(law.shear_modulus, 290);
}

TEST(FlowModels, AMaterialMadeFromAMeasuredFlowCurveFlowsByIt) {
  // A soap foam's, a dry foam's and an emulsion's kind of curve, over four decades of the rate.
  for (const char* text : {"18:12:0.4", "55:5.5:0.47", "18.4:17.8:0.22", "0:3:1"}) {
    const PowerLaw measured = read_power_law(text);
    HerschelBulkleyParameters law = {77.7, 109e3, 0, 0, 0, 1};
    // Stiff: s/mu = sqrt(2) tau/mu is 0.01 at the highest rate.
    law.shear_modulus = 100 * std::sqrt(2.0) * stress_at(measured, 100);
    set_flow(law, measured);
    for (const SteadyFlow& flow : flow_curve(law, {0.01, 100, 9})) {
      // An elastic strain of 0.01 changes the stress by its square, 1e-4, and the law's step of 1e-4 by its
      // own size.
      EXPECT_NEAR(flow.stress.tau_xy, stress_at(measured, flow.rate), 3e-4 * flow.stress.tau_xy)
          << text << " at " << flow.rate << "/s";
    }
  }
}

TEST(FlowModels, RefusesWhatIsNoMeasuredFlowCurve) {
  for (const char* text : {"", "18", "18:12", "18:12:0", "18:-12:0.4", "-1:12:0.4", "18:12:0.4:1", "a:b:c",
                           "18:12:inf", "18:12:nan"})
    EXPECT_THROW((void)read_power_law(text), InputError) << text;
}

TEST(FlowModels, EffectiveViscosityIsTheStressOverTheFlow) {
  const HerschelBulkleyParameters law = {77.7, 109e3, 290, 31.9, 27.2, 0.22};
  for (const double excess : {0.5, 5.0, 50.0}) {
    const double flow = std::pow(excess / law.viscosity, 1 / law.flow_index);
    EXPECT_NEAR(effective_viscosity(law, excess), excess / flow, 1e-12 * excess / flow);
  }
}

TEST(FlowModels, WithStressThisLawThinsBargteilsThickensAndBinghamsStays) {
  const HerschelBulkleyParameters law = {77.7, 109e3, 290, 31.9, 27.2, 0.22};
  const auto curve = flow_curve(law, {0.1, 10, 5});
  const ViscosityComparison v = compare_viscosities(law, curve);
  EXPECT_NEAR(v.matched_rate, 1, 1e-12);
  EXPECT_DOUBLE_EQ(v.bargteil[2], v.herschel_bulkley[2]);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_LT(v.herschel_bulkley[i], v.herschel_bulkley[i - 1]);
    EXPECT_GT(v.bargteil[i], v.bargteil[i - 1]);
    EXPECT_EQ(v.viscoplastic[i], v.viscoplastic[0]);
  }
}

}  // namespace
}  // namespace lather::study
