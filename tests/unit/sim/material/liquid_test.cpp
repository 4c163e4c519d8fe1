// The equation of state and the viscosity of liquids [MLSRK Fig. 3, eq. 23], and the correction of volumes
// [MLSRK eq. 19], at single points.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "sim/material/equation_of_state_make.h"
#include "sim/material/law_points.h"
#include "sim/material/newtonian_make.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

using Mat = Eigen::Matrix3d;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

class Liquid : public testing::TestWithParam<KernelLevel> {
 protected:
  [[nodiscard]] const LawPointTable<double>& table() const { return law_point_kernels<double>(GetParam()); }

  [[nodiscard]] double pressure(const EquationOfStateConstants<double>& c, double j) const {
    double p = 0;
    table().wide.liquid_pressure(c, &j, 1, &p);
    return p;
  }
  [[nodiscard]] double energy(const EquationOfStateConstants<double>& c, double j) const {
    double w = 0;
    table().wide.liquid_energy(c, &j, 1, &w);
    return w;
  }
};

TEST_P(Liquid, PressureFollowsTheEquationOfState) {
  LiquidParameters water;
  water.bulk_modulus = 1e6;
  water.exponent = 7;
  const auto c = equation_of_state_constants<double>(water);
  for (const double J : {0.2, 0.5, 0.9, 0.99, 1.0}) {
    const double exact = 1e6 / 7 * (std::pow(J, -7) - 1);
    EXPECT_NEAR(pressure(c, J - 1), exact, 1e-13 * (1e6 + exact)) << J;
  }
}

TEST_P(Liquid, AStretchedLiquidDoesNotPull) {
  const EquationOfStateConstants<double> c = {1e6, 7};
  for (const double j : {1e-12, 0.01, 3.0}) {
    EXPECT_EQ(pressure(c, j), 0);
    EXPECT_EQ(energy(c, j), 0);
  }
}

TEST_P(Liquid, ACollapsedPointHasNoPressureThatOneCouldMistakeForRest) {
  const EquationOfStateConstants<double> c = {1e6, 7};
  const double j = -1.5;
  double p = 0;
  table().scalar.liquid_pressure(c, &j, 1, &p);
  EXPECT_TRUE(std::isnan(p));
  EXPECT_TRUE(std::isnan(pressure(c, j)));
}

TEST_P(Liquid, SmallCompressionsKeepTheirDigitsInFloat) {
  const auto& in_float = law_point_kernels<float>(GetParam());
  for (const float j : {-1e-7F, -3e-6F, -1e-4F}) {
    const double exact_p = -1e6 / 7 * -std::expm1(-7 * std::log1p(double{j}));
    const double x = double{j};
    const double exact_w = 1e6 * x * x / 2 * (1 - 8 * x / 3);  // to the third order, of x
    float p = 0;
    float w = 0;
    for (const auto* kernels : {&in_float.wide, &in_float.scalar}) {
      kernels->liquid_pressure({1e6F, 7}, &j, 1, &p);
      kernels->liquid_energy({1e6F, 7}, &j, 1, &w);
      EXPECT_NEAR(double{p} / exact_p, 1, 1e-6) << j;
      EXPECT_NEAR(double{w} / exact_w, 1, 2e-6) << j;
    }
  }
}

TEST_P(Liquid, PressureIsMinusTheDerivativeOfTheEnergy) {
  for (const double exponent : {1.0, 1.5, 7.0}) {
    const EquationOfStateConstants<double> c = {2, exponent};
    for (const double j : {-0.6, -0.2, -0.02, -1e-3}) {
      const double e = 1e-3 * j;  // central differences: their error is of order (e/j)^2 e/j at worst
      const double slope =
          (8 * (energy(c, j + e) - energy(c, j - e)) - (energy(c, j + 2 * e) - energy(c, j - 2 * e))) /
          (12 * e);
      EXPECT_NEAR(-slope, pressure(c, j), 1e-9 * pressure(c, j)) << exponent << " " << j;
    }
  }
}

TEST_P(Liquid, ViscousStressOfSimpleShearIsViscosityTimesRate) {
  const double L[9] = {0, 40, 0, 0, 0, 0, 0, 0, 0};
  for (const int dimension : {2, 3})
    for (const auto* kernels : {&table().wide, &table().scalar}) {
      double s[6];
      kernels->viscous_stress(newtonian_constants<double>({2.5, 7}), dimension, L, 1, s);
      EXPECT_EQ(s[3], 100);
      for (const int i : {0, 1, 2, 4, 5}) EXPECT_EQ(s[i], 0);
    }
}

TEST_P(Liquid, OnlyTheBulkViscosityResistsExpansionInBothDimensions) {
  const double solid[9] = {3, 0, 0, 0, 3, 0, 0, 0, 3};
  const double plane[9] = {3, 0, 0, 0, 3, 0, 0, 0, 0};
  double s[6];
  table().wide.viscous_stress({2.5, 7}, 3, solid, 1, s);
  for (const int i : {0, 1, 2}) EXPECT_NEAR(s[i], 7 * 9, 1e-13);
  table().wide.viscous_stress({2.5, 7}, 2, plane, 1, s);
  for (const int i : {0, 1}) EXPECT_NEAR(s[i], 7 * 6, 1e-13);
  EXPECT_EQ(s[2], 0);
}

TEST_P(Liquid, ViscousStressIsThePapersForAnyGradient) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-10, 10);
  for (int n = 0; n < 50; ++n) {
    Rows L;
    for (int i = 0; i < 9; ++i) L(i / 3, i % 3) = u(rng);
    double s[6];
    table().wide.viscous_stress({2.5, 7}, 3, L.data(), 1, s);
    Mat sigma;
    sigma << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    const Mat expected =
        2.5 * (L + L.transpose() - 2.0 / 3 * L.trace() * Mat::Identity()) + 7 * L.trace() * Mat::Identity();
    EXPECT_LE((sigma - expected).norm(), 1e-12);
    EXPECT_GE(sigma.cwiseProduct(L).sum(), 0);  // it takes energy, never gives
  }
}

/// A G of some size, in the plane where there are two dimensions.
template <class Real>
Eigen::Matrix<Real, 3, 3, Eigen::RowMajor> random_difference(std::mt19937& rng, int dimension, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  Eigen::Matrix<Real, 3, 3, Eigen::RowMajor> G = Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>::Zero();
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) G(i, j) = static_cast<Real>(u(rng));
  return G;
}

TEST_P(Liquid, TheCorrectedVolumeIsThatOfTheNeighboursAndTheShapeStays) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(0.3, 3);
  for (int n = 0; n < 200; ++n) {
    const int dimension = 2 + n % 2;
    const Rows G = random_difference<double>(rng, dimension, 0.3);
    Rows corrected = G;
    const double ratio = u(rng);
    const double J_p = n % 4 < 2 ? 1 : u(rng);
    const double target = ratio - 1;
    const double plastic_volume = J_p - 1;
    (n % 3 == 0 ? table().scalar : table().wide)
        .correct_volume(dimension, &target, &plastic_volume, 1, corrected.data());
    const Mat F = Mat::Identity() + G;
    const Mat after = Mat::Identity() + corrected;
    EXPECT_NEAR(after.determinant() * J_p, ratio, 1e-14 * (1 + ratio));
    const Mat change = after * F.inverse();
    EXPECT_NEAR(change(0, 0), std::pow(ratio / J_p / F.determinant(), 1.0 / dimension), 1e-13);
    EXPECT_NEAR(change(1, 1), change(0, 0), 1e-13);
    EXPECT_NEAR(change(0, 1), 0, 1e-13);
    if (dimension == 2) {
      for (const int i : {2, 5, 6, 7, 8}) EXPECT_EQ(corrected.data()[i], 0);
    }
  }
}

TEST_P(Liquid, SmallCorrectionsKeepTheirDigitsInFloat) {
  std::mt19937 rng(3);
  for (int n = 0; n < 50; ++n) {
    auto G = random_difference<float>(rng, 3, 1e-6);
    const float target = 3e-6F;
    const float plastic_volume = 0;
    law_point_kernels<float>(GetParam()).wide.correct_volume(3, &target, &plastic_volume, 1, G.data());
    const Mat g = G.cast<double>();
    EXPECT_NEAR((Mat::Identity() + g).determinant() - 1, 3e-6, 3e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Liquid, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
