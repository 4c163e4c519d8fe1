// Start-up of simple shear in a box by both solvers: the law must come out of the whole method as it went in.

#include "sim/study/shear_box.h"

#include <gtest/gtest.h>

#include "tests/support/reference_data.h"

namespace lather {
namespace {

using testing_support::SimpleShearRun;

class ShearBox : public testing::TestWithParam<SimpleShearRun> {};

/// `share`: of the largest s, that each stress may be off by.
void expect_reference(const SimpleShearRun& run, Solver solver, double share) {
  const int intervals = static_cast<int>(run.t.size()) - 1;
  const study::StartUp got =
      study::start_up_in_box(run.law(), {run.shear_rate, run.t.back(), intervals}, 1, solver);
  ASSERT_EQ(got.stress.size(), run.t.size());
  const double bound = share * run.largest_s();
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    ASSERT_NEAR(got.t[i], run.t[i], 1e-9 * run.t.back());
    EXPECT_NEAR(got.stress[i].tau_xy, run.tau_xy[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.stress[i].n1, run.n1[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.stress[i].s, run.s[i], bound) << "t = " << run.t[i];
  }
}

TEST_P(ShearBox, StressesFollowTheReferenceWithinTwoPercent) {
  expect_reference(GetParam(), Solver::kMpm, 0.02);
}

// Points on a lattice have the flow's gradient to rounding; a step of 6.7e-4 in shear leaves the stress half
// a step late where it rises fastest, by its modulus.
TEST_P(ShearBox, ParticlesFollowItWithinAFifthOfAPercent) {
  expect_reference(GetParam(), Solver::kMlsrk, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Reference, ShearBox, testing::ValuesIn(testing_support::simple_shear_runs()),
                         [](const auto& test) { return "Run" + std::to_string(test.index); });

}  // namespace
}  // namespace lather
