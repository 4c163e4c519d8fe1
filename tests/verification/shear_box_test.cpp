// Start-up of simple shear in an MPM box: the law must come out of the whole method as it went in.

#include "sim/study/shear_box.h"

#include <gtest/gtest.h>

#include "tests/support/reference_data.h"

namespace lather {
namespace {

using testing_support::SimpleShearRun;

class ShearBox : public testing::TestWithParam<SimpleShearRun> {};

TEST_P(ShearBox, StressesFollowTheReferenceWithinTwoPercent) {
  const SimpleShearRun& run = GetParam();
  const int intervals = static_cast<int>(run.t.size()) - 1;
  const study::StartUp got = study::start_up_in_box(run.law(), {run.shear_rate, run.t.back(), intervals}, 1);
  ASSERT_EQ(got.stress.size(), run.t.size());
  const double bound = 0.02 * run.largest_s();
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    ASSERT_NEAR(got.t[i], run.t[i], 1e-9 * run.t.back());
    EXPECT_NEAR(got.stress[i].tau_xy, run.tau_xy[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.stress[i].n1, run.n1[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.stress[i].s, run.s[i], bound) << "t = " << run.t[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, ShearBox, testing::ValuesIn(testing_support::simple_shear_runs()),
                         [](const auto& test) { return "Run" + std::to_string(test.index); });

}  // namespace
}  // namespace lather
