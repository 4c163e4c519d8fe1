// The kernels of the grid: partition of unity, linear reproduction, derivatives.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

class Weights : public testing::TestWithParam<KernelLevel> {};

/// Cubic B-spline of [Foam E.1] at distance x in cells.
double cubic(double x) {
  x = std::abs(x);
  if (x < 1) return 0.5 * x * x * x - x * x + 2.0 / 3;
  return x < 2 ? std::pow(2 - x, 3) / 6 : 0;
}
double quadratic(double x) {
  x = std::abs(x);
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}

template <class Real>
void expect_identities(KernelLevel level) {
  const auto weights = mpm::kernel_table<Real>(level).point.weights;
  const double eps = std::numeric_limits<Real>::epsilon();
  for (const bool is_cubic : {true, false})
    for (int i = 0; i <= 1000; ++i) {
      const double f = i / 1000.0;
      Real w[4];
      Real d[4];
      const int first = weights(is_cubic, static_cast<Real>(f), w, d);
      double sum = 0;
      double slope = 0;
      double linear = 0;
      double moment = 0;
      for (int n = 0; n < 4; ++n) {
        const double x = first + n - static_cast<double>(static_cast<Real>(f));
        EXPECT_NEAR(w[n], is_cubic ? cubic(x) : quadratic(x), 2 * eps);
        EXPECT_GE(w[n], -eps);
        sum += w[n];
        slope += d[n];
        linear += w[n] * x;
        moment += w[n] * x * x;
      }
      EXPECT_NEAR(sum, 1, 3 * eps) << f;
      EXPECT_NEAR(slope, 0, 4 * eps) << f;
      EXPECT_NEAR(linear, 0, 4 * eps) << f;
      EXPECT_NEAR(moment, is_cubic ? 1.0 / 3 : 0.25, 6 * eps) << f;  // D of APIC, over h^2
    }
}

TEST_P(Weights, AddUpToOneAndReproduceLinearFields) {
  expect_identities<float>(GetParam());
  expect_identities<double>(GetParam());
}

TEST_P(Weights, DerivativesAreThoseOfTheWeights) {
  const auto weights = mpm::kernel_table<double>(GetParam()).point.weights;
  for (const bool is_cubic : {true, false})
    for (const double f : {0.05, 0.3, 0.45, 0.7, 0.95}) {
      double w[4];
      double up[4];
      double down[4];
      double d[4];
      double unused[4];
      weights(is_cubic, f, w, d);
      weights(is_cubic, f + 1e-6, up, unused);
      weights(is_cubic, f - 1e-6, down, unused);
      for (int n = 0; n < 4; ++n) EXPECT_NEAR(d[n], (up[n] - down[n]) / 2e-6, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, Weights, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
