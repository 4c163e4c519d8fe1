// Closed forms of steady flow.

#include "sim/study/flow_models.h"

#include <gtest/gtest.h>

#include <cmath>

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
