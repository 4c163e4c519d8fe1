// The return mapping [Foam eq. 16] and eigenvalues over all that a number may be, subnormal ones included,
// against the same in long double.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

using Long = long double;

/// Positive, every exponent as likely as any other, those of subnormal numbers too.
template <class Real>
Real any_positive(std::mt19937_64& rng) {
  using Limits = std::numeric_limits<Real>;
  constexpr int kLeast = Limits::min_exponent - Limits::digits;  // that of the least subnormal number
  std::uniform_int_distribution<int> exponent(kLeast, Limits::max_exponent - 1);
  std::uniform_real_distribution<double> fraction(0.5, 1);
  return std::max(std::ldexp(static_cast<Real>(fraction(rng)), exponent(rng)), Limits::denorm_min());
}

double by_order(std::mt19937_64& rng, double low, double high) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(rng));
}

template <class Real>
struct Yielding {
  HerschelBulkleyConstants<Real> law;
  Real excess_pre;
  Real two_mu_dt;
};

/// The law within the ranges of a scene, the state anywhere.
template <class Real>
Yielding<Real> any_yielding(std::mt19937_64& rng) {
  const double eta = by_order(rng, 1e-9, 1e9);
  const double h = by_order(rng, 0.05, 10);
  return {{1, 1, 0, static_cast<Real>(eta), static_cast<Real>(h), static_cast<Real>(1 / h),
           std::numeric_limits<Real>::epsilon()},
          any_positive<Real>(rng),
          any_positive<Real>(rng)};
}

/// ln of x in x + K x^(1/h) = 1, by bisection; ln K given.
Long log_root(Long log_K, Long inverse_h) {
  // Either term is at most 1 at the root, and one of them at least 1/2.
  Long low = std::min(-std::log(2.0L), (-std::log(2.0L) - log_K) / inverse_h) - 1;
  Long high = 0;
  for (int i = 0; i < 200; ++i) {
    const Long middle = (low + high) / 2;
    const Long sum = std::exp(middle) + std::exp(std::min(log_K + middle * inverse_h, 1.0L));
    (sum < 1 ? low : high) = middle;
  }
  return low;
}

template <class Real>
void expect_excess_of_any_state(const mpm::PointKernels<Real>& kernels) {
  using Limits = std::numeric_limits<Real>;
  std::mt19937_64 rng(7);
  int compared = 0;
  for (int n = 0; n < 20'000; ++n) {
    const Yielding<Real> y = any_yielding<Real>(rng);
    Real excess = -1;
    kernels.plastic_excess(y.law, &y.excess_pre, &y.two_mu_dt, 1, &excess);
    const auto where = [&] {
      return testing::Message() << "e " << y.excess_pre << " 2 mu dt " << y.two_mu_dt << " eta "
                                << y.law.viscosity << " h " << y.law.flow_index;
    };
    // Logarithms of up to a hundred (float) or seven hundred (double) are rounded, and multiplied by h or
    // 1/h.
    const Long e = y.excess_pre;
    const Long log_e = std::log(e / y.law.viscosity);
    const Long log_rate = std::log(static_cast<Long>(y.two_mu_dt) / e);
    const Long h = y.law.flow_index;
    const Long slack = 8 * Limits::epsilon() *
                       (1 + std::abs(log_e) * (1 + 1 / h) + std::abs(log_rate) * (1 + h) + h + 1 / h);
    ASSERT_TRUE(std::isfinite(excess)) << where();
    ASSERT_GE(excess, 0) << where();
    ASSERT_LE(excess, e * (1 + slack)) << where();
    // Beyond the normal numbers the two quotients that the mapping begins with have lost their digits.
    const auto normal = [](Long value) { return value > Limits::min() && value < Limits::max(); };
    if (!normal(y.two_mu_dt / e) || !normal(e / y.law.viscosity)) continue;
    ++compared;
    const Long expected = e * std::exp(log_root(log_rate + log_e / h, 1 / h));
    // The share of e that stays underflows where it is less than any normal number.
    const Long underflow = 4 * (Limits::denorm_min() + Limits::min() * e);
    ASSERT_NEAR(static_cast<Long>(excess), expected, slack * expected + underflow) << where();
  }
  EXPECT_GT(compared, 5'000);
}

template <class Real>
void expect_eigenvalues_at_any_scale(const mpm::TearingKernels<Real>& kernels) {
  using Limits = std::numeric_limits<Real>;
  using Matrix = Eigen::Matrix<Long, 3, 3>;
  std::mt19937_64 rng(9);
  for (int n = 0; n < 3'000; ++n) {
    // Entries of one size or of any sizes; an eigenvalue is at most three of the largest one.
    const Real size = any_positive<Real>(rng) / 4;
    Real a[6];
    for (Real& entry : a) {
      entry = n % 2 == 0 ? static_cast<Real>(size * std::uniform_real_distribution<double>(-1, 1)(rng))
                         : any_positive<Real>(rng) / 4;
      if (rng() % 2 == 0) entry = -entry;
    }
    Real value[3];
    Real vector[9];
    kernels.eigenpairs(a, value, vector);
    Matrix A;
    A << a[0], a[3], a[4], a[3], a[1], a[5], a[4], a[5], a[2];
    const Long largest = A.cwiseAbs().maxCoeff();
    // In units of the largest entry, for long double solves equations of squares.
    const Long unit = largest > 0 ? largest : 1;
    Eigen::Matrix<Long, 3, 1> expected =
        Eigen::SelfAdjointEigenSolver<Matrix>(A / unit, Eigen::EigenvaluesOnly).eigenvalues() * unit;
    std::sort(value, value + 3);
    const Long bound = 20 * static_cast<Long>(Limits::epsilon()) * largest + 4 * Limits::denorm_min();
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(static_cast<Long>(value[k]), expected[k], bound) << A;
  }
}

class FullRange : public testing::TestWithParam<KernelLevel> {};

TEST_P(FullRange, PlasticExcessOfAnyStateIsThatOfLongDouble) {
  expect_excess_of_any_state(mpm::kernel_table<float>(GetParam()).point);
  expect_excess_of_any_state(mpm::kernel_table<double>(GetParam()).point);
}

TEST_P(FullRange, EigenvaluesAtAnyScaleAreThoseOfLongDouble) {
  expect_eigenvalues_at_any_scale(mpm::kernel_table<float>(GetParam()).point.tearing_wide);
  expect_eigenvalues_at_any_scale(mpm::kernel_table<double>(GetParam()).point.tearing_wide);
}

INSTANTIATE_TEST_SUITE_P(Levels, FullRange, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
