// The plastic correction [Foam eq. 16] against solutions of 25 digits, in both precisions, wide and scalar.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"
#include "tests/support/reference_data.h"

namespace lather {
namespace {

using testing_support::ReturnMapCase;

template <class Real>
HerschelBulkleyConstants<Real> constants_of(const ReturnMapCase& c) {
  return {Real(1),
          Real(1),
          static_cast<Real>(std::sqrt(2.0 / 3.0) * c.sigma_y),
          static_cast<Real>(c.eta),
          static_cast<Real>(c.h),
          static_cast<Real>(1 / c.h),
          std::numeric_limits<Real>::epsilon()};
}

/// `relative`: of the excess. The input s_pre - sqrt(2/3) sigma_Y is itself known to a few epsilon s_pre
/// only.
template <class Real>
void expect_reference_excess(KernelLevel level, bool wide, double relative) {
  const auto& kernels = mpm::kernel_table<Real>(level).point;
  const auto cases = testing_support::return_map_cases();
  ASSERT_EQ(cases.size(), 296U);
  for (const ReturnMapCase& c : cases) {
    const auto constants = constants_of<Real>(c);
    const Real excess_pre = static_cast<Real>(c.s_pre) - constants.yield_radius;
    const auto two_mu_dt = static_cast<Real>(2 * c.mu_tilde_dt);
    Real excess = -1;
    (wide ? kernels.plastic_excess : kernels.plastic_excess_scalar)(constants, &excess_pre, &two_mu_dt, 1,
                                                                    &excess);
    const double bound = relative * c.excess + 8 * std::numeric_limits<Real>::epsilon() * c.s_pre;
    EXPECT_NEAR(static_cast<double>(excess), c.excess, bound)
        << "s_pre " << c.s_pre << " mu~dt " << c.mu_tilde_dt << " sigma_Y " << c.sigma_y << " eta " << c.eta
        << " h " << c.h;
  }
}

class ReturnMap : public testing::TestWithParam<KernelLevel> {};

TEST_P(ReturnMap, DoubleMeetsAllReferenceCases) {
  expect_reference_excess<double>(GetParam(), true, 1e-9);
}
TEST_P(ReturnMap, FloatMeetsAllReferenceCases) {
  expect_reference_excess<float>(GetParam(), true, 1e-4);
}
TEST_P(ReturnMap, ScalarTwinMeetsThemToo) {
  expect_reference_excess<double>(GetParam(), false, 1e-9);
  expect_reference_excess<float>(GetParam(), false, 1e-4);
}

TEST_P(ReturnMap, LanesBelowYieldGiveNoExcessWhateverTheirNeighboursDo) {
  const auto& kernels = mpm::kernel_table<double>(GetParam()).point;
  const HerschelBulkleyConstants<double> c{1, 1, 10, 16, 0.43, 1 / 0.43, 2.2e-16};
  const double pre[5] = {-3, 7, 0, 1e-12, -1e9};
  const double two_mu_dt[5] = {0.1, 0.1, 0.1, 0.1, 0.1};
  double excess[5];
  kernels.plastic_excess(c, pre, two_mu_dt, 5, excess);
  EXPECT_EQ(excess[0], 0);
  EXPECT_GT(excess[1], 0);
  EXPECT_LT(excess[1], 7);
  EXPECT_EQ(excess[2], 0);
  EXPECT_NEAR(excess[3], 1e-12, 1e-14);  // far below eta, the rate is nil: all of it stays
  EXPECT_EQ(excess[4], 0);
}

INSTANTIATE_TEST_SUITE_P(Levels, ReturnMap, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
