// The return mappings of snow and of Drucker and Prager [MLSRK section 4.3.4] against values of independent
// arithmetic at 25 digits, in both precisions, wide and scalar.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/material/law_points.h"
#include "tests/support/kernel_levels.h"
#include "tests/support/reference_data.h"
#include "tests/unit/sim/material/plastic_laws.h"

namespace lather {
namespace {

using testing_support::DruckerPragerCase;
using testing_support::PlasticCase;
using testing_support::SnowCase;

template <class Real>
struct Point {
  std::array<Real, 9> G;
  Real plastic_volume;

  explicit Point(const PlasticCase& c) : plastic_volume(static_cast<Real>(c.plastic_volume)) {
    for (std::size_t i = 0; i < G.size(); ++i) G[i] = static_cast<Real>(c.trial[i] - (i % 4 == 0 ? 1 : 0));
  }

  void expect(const PlasticCase& c, double share) const {
    double largest = 0;
    double error = 0;
    for (std::size_t i = 0; i < G.size(); ++i) {
      const double entry = static_cast<double>(G[i]) + (i % 4 == 0 ? 1 : 0);
      largest = std::max(largest, std::abs(c.expected[i]));
      error = std::max(error, std::abs(entry - c.expected[i]));
    }
    EXPECT_LE(error, share * largest);
    EXPECT_NEAR(static_cast<double>(plastic_volume), c.expected_plastic_volume,
                share * (1 + c.expected_plastic_volume));
  }
};

DruckerPragerParameters parameters(const DruckerPragerCase& c) {
  DruckerPragerParameters p;
  const double lambda = c.lame_lambda;
  const double mu = c.lame_mu;
  p.elastic = {1000, mu * (3 * lambda + 2 * mu) / (lambda + mu), lambda / (2 * (lambda + mu))};
  p.friction_angle_deg = c.friction_angle_deg;
  p.cohesion = c.cohesion;
  return p;
}

class PlasticReference : public testing::TestWithParam<KernelLevel> {};

template <class Real>
void expect_drucker_prager(const LawPointKernels<Real>& kernels, double share) {
  const auto cases = testing_support::drucker_prager_cases();
  ASSERT_EQ(cases.size(), 120U);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const DruckerPragerCase& c = cases[n];
    SCOPED_TRACE("case " + std::to_string(n) + ", " + c.branch);
    Point<Real> p(c);
    kernels.drucker_prager(drucker_prager_constants<Real>(parameters(c), c.dimension), c.dimension, 1,
                           p.G.data(), &p.plastic_volume);
    p.expect(c, share);
  }
}

template <class Real>
void expect_snow(const LawPointKernels<Real>& kernels, double share) {
  const auto cases = testing_support::snow_cases();
  ASSERT_EQ(cases.size(), 60U);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const SnowCase& c = cases[n];
    SCOPED_TRACE("case " + std::to_string(n));
    Point<Real> p(c);
    const auto constants = snow_constants<Real>({{}, c.theta_c, c.theta_s, c.hardening});
    kernels.snow(constants, c.dimension, 1, p.G.data(), &p.plastic_volume);
    p.expect(c, share);
    Real factor = 0;
    kernels.hardening(constants.hardening, &p.plastic_volume, 1, &factor);
    // An error of J_p arrives times xi.
    EXPECT_NEAR(static_cast<double>(factor), c.stiffness_factor, share * c.stiffness_factor * c.hardening);
  }
}

TEST_P(PlasticReference, DruckerPragerMeetsAllCases) {
  const auto& in_double = law_point_kernels<double>(GetParam());
  const auto& in_float = law_point_kernels<float>(GetParam());
  expect_drucker_prager(in_double.wide, 1e-9);
  expect_drucker_prager(in_double.scalar, 1e-9);
  expect_drucker_prager(in_float.wide, 1e-4);
  expect_drucker_prager(in_float.scalar, 1e-4);
}

TEST_P(PlasticReference, SnowMeetsAllCases) {
  const auto& in_double = law_point_kernels<double>(GetParam());
  const auto& in_float = law_point_kernels<float>(GetParam());
  expect_snow(in_double.wide, 1e-9);
  expect_snow(in_double.scalar, 1e-9);
  expect_snow(in_float.wide, 1e-4);
  expect_snow(in_float.scalar, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Levels, PlasticReference, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
