// The neo-Hookean solid [MLSRK eq. 20-22] and the principal stretches below it, at single points.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "sim/material/law_points.h"
#include "sim/material/neo_hookean_make.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

using Mat = Eigen::Matrix3d;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kLambda = 3;
constexpr double kMu = 2;

Mat random_matrix(std::mt19937& rng, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  Mat m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = u(rng);
  return m;
}

Mat symmetric(const double (&t)[6]) {
  Mat m;
  m << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  return m;
}

/// [MLSRK eq. 20] from F in long double, so that differences of it keep their digits.
double energy(const Mat& F) {
  const Eigen::Matrix<long double, 3, 3> f = F.cast<long double>();
  const long double log_J = std::log(f.determinant());
  const long double shape = (f * f.transpose()).trace() - 3;
  return static_cast<double>(kMu / 2 * shape - kMu * log_J + kLambda / 2 * log_J * log_J);
}

class NeoHookean : public testing::TestWithParam<KernelLevel> {
 protected:
  [[nodiscard]] const LawPointTable<double>& table() const { return law_point_kernels<double>(GetParam()); }

  [[nodiscard]] Mat stress(const LawPointKernels<double>& kernels, const Mat& G) const {
    const Rows rows = G;
    double tau[6];
    kernels.neo_hookean_stress({kLambda, kMu}, rows.data(), 1, tau);
    return symmetric(tau);
  }
};

TEST_P(NeoHookean, StressIsTheDerivativeOfTheEnergy) {
  std::mt19937 rng(1);
  for (int i = 0; i < 200; ++i) {
    const Mat G = random_matrix(rng, 0.3);
    const Mat F = Mat::Identity() + G;
    const Mat tau = stress(i % 2 == 0 ? table().wide : table().scalar, G);
    // dW(F + e D F)/de = tau : D for every velocity gradient D; central differences, error of order e^2.
    const double e = 1e-5;
    const Mat D = random_matrix(rng, 1);
    const double slope = (energy(F + e * D * F) - energy(F - e * D * F)) / (2 * e);
    EXPECT_NEAR(slope, tau.cwiseProduct(D).sum(), 1e-8 * (1 + tau.norm() * D.norm()));
  }
}

TEST_P(NeoHookean, EnergyIsThatOfThePaper) {
  std::mt19937 rng(2);
  for (int i = 0; i < 200; ++i) {
    const Mat G = random_matrix(rng, 0.3);
    const Rows rows = G;
    double w = 0;
    (i % 2 == 0 ? table().wide : table().scalar).neo_hookean_energy({kLambda, kMu}, rows.data(), 1, &w);
    EXPECT_NEAR(w, energy(Mat::Identity() + G), 1e-13 * (1 + w));
  }
}

TEST_P(NeoHookean, ModuliAreThoseOfSmallStrains) {
  // sigma_xx = E e in uniaxial stress, where the other strains are -nu e.
  const ElasticParameters p = {1000, 2e5, 0.3};
  const auto c = neo_hookean_constants<double>(p);
  const double e = 1e-7;
  const double G[9] = {e, 0, 0, 0, -0.3 * e, 0, 0, 0, -0.3 * e};
  double tau[6];
  table().wide.neo_hookean_stress(c, G, 1, tau);
  EXPECT_NEAR(tau[0], 2e5 * e, 1e-6 * 2e5 * e);  // strains squared are 1e-7 of strains
  EXPECT_NEAR(tau[1], 0, 1e-6 * 2e5 * e);
}

TEST_P(NeoHookean, SmallStrainsKeepTheirDigitsInFloat) {
  std::mt19937 rng(3);
  const auto& in_float = law_point_kernels<float>(GetParam()).wide;
  for (int i = 0; i < 100; ++i) {
    const Rows G = random_matrix(rng, 1e-6);
    float g[9];
    std::copy_n(G.data(), 9, g);
    const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> rounded = G.cast<float>();
    const Rows exact = rounded.cast<double>();
    double tau[6];
    double w = 0;
    table().scalar.neo_hookean_stress({kLambda, kMu}, exact.data(), 1, tau);
    table().scalar.neo_hookean_energy({kLambda, kMu}, exact.data(), 1, &w);
    float tau_float[6];
    float w_float = 0;
    in_float.neo_hookean_stress({3, 2}, g, 1, tau_float);
    in_float.neo_hookean_energy({3, 2}, g, 1, &w_float);
    // A few roundings of sums of strains of 1e-6 times moduli of about 3; the energy is a sum of squares.
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(double{tau_float[k]}, tau[k], 1e-11);
    EXPECT_NEAR(double{w_float}, w, 4e-6 * w);
  }
}

TEST_P(NeoHookean, StressInThePlaneIsThatOfPlaneStrain) {
  const double G[9] = {0.1, 0.05, 0, -0.02, -0.2, 0, 0, 0, 0};
  double tau[6];
  table().wide.neo_hookean_stress({kLambda, kMu}, G, 1, tau);
  EXPECT_NEAR(tau[2], kLambda * std::log(1.1 * 0.8 + 0.05 * 0.02), 1e-15);
  EXPECT_EQ(tau[4], 0);
  EXPECT_EQ(tau[5], 0);
}

TEST_P(NeoHookean, ARotatedSolidBearsNoStress) {
  const Mat R = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  EXPECT_LE(stress(table().wide, R - Mat::Identity()).norm(), 1e-14);
}

TEST_P(NeoHookean, StretchesAreTheSingularValuesAndTheirVectorsDiagonaliseC) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Eigen::JacobiSVD<Mat> turn(random_matrix(rng, 1), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double range = i % 3 == 0 ? 1e-4 : i % 3 == 1 ? 0.5 : std::log(1e3);
    Eigen::Array3d expected(range * u(rng), range * u(rng), range * u(rng));
    const Mat F = turn.matrixU() * Mat(expected.exp().matrix().asDiagonal()) * turn.matrixV().transpose();
    const Rows G = (turn.matrixU() * turn.matrixV().transpose()).determinant() < 0 ? Mat(-F - Mat::Identity())
                                                                                   : Mat(F - Mat::Identity());
    Eigen::Array3d log;
    Rows right;
    (i % 2 == 0 ? table().wide : table().scalar).stretches(G.data(), 1, log.data(), right.data());
    EXPECT_LE((right * right.transpose() - Mat::Identity()).norm(), 1e-14);
    const double largest = std::exp(expected.maxCoeff());
    const Mat image = (Mat::Identity() + G) * right.transpose();
    for (int k = 0; k < 3; ++k)  // to a few roundings of G
      EXPECT_NEAR(image.col(k).norm(), std::exp(log(k)), 1e-14 * (1 + largest));
    std::sort(log.data(), log.data() + 3);
    std::sort(expected.data(), expected.data() + 3);
    const double condition = (1 + largest) / std::exp(expected(0));
    EXPECT_LE((log - expected).abs().maxCoeff(), 1e-14 * condition) << expected.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, NeoHookean, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
