// The Herschel-Bulkley law at single points: energy, indifference, simple shear, the scalar twin.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"
#include "tests/support/reference_data.h"

namespace lather {
namespace {

using Mat = Eigen::Matrix3d;
using testing_support::SimpleShearRun;

template <class Real>
HerschelBulkleyConstants<Real> constants(double kappa, double mu, double sigma_y, double eta, double h) {
  return {static_cast<Real>(kappa),
          static_cast<Real>(mu),
          static_cast<Real>(std::sqrt(2.0 / 3.0) * sigma_y),
          static_cast<Real>(eta),
          static_cast<Real>(h),
          static_cast<Real>(1 / h),
          std::numeric_limits<Real>::epsilon()};
}
const double kElastic = std::numeric_limits<double>::infinity();

struct PointState {
  double s[7] = {};  // J - 1, B xx yy zz xy xz yz

  [[nodiscard]] Mat strain() const {
    Mat b;
    b << s[1], s[4], s[5], s[4], s[2], s[6], s[5], s[6], s[3];
    return b;
  }
};

Mat random_matrix(std::mt19937& rng, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  Mat m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = u(rng);
  return m;
}

Mat random_rotation(std::mt19937& rng) {
  const Eigen::HouseholderQR<Mat> qr(random_matrix(rng, 1));
  Mat q = qr.householderQ();
  if (q.determinant() < 0) q.col(0) *= -1;
  return q;
}

class Law : public testing::TestWithParam<KernelLevel> {
 protected:
  [[nodiscard]] const mpm::PointKernels<double>& kernels() const {
    return mpm::kernel_table<double>(GetParam()).point;
  }

  /// State after the deformation F = I + A in one step.
  [[nodiscard]] PointState deform(const HerschelBulkleyConstants<double>& c, const Mat& A, double dt = 1e-3,
                                  PointState state = {}) const {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = A;
    kernels().law_step(c, rows.data(), dt, state.s);
    return state;
  }
  [[nodiscard]] Mat stress(const HerschelBulkleyConstants<double>& c, const PointState& state) const {
    double t[6];
    kernels().stress(c, state.s, t);
    Mat tau;
    tau << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
    return tau;
  }
};

/// W of [Foam eq. 1], Pa, from F in long double, so that differences of it keep their digits.
double energy(double kappa, double mu, const Mat& F) {
  const Eigen::Matrix<long double, 3, 3> f = F.cast<long double>();
  const long double J = f.determinant();
  const long double trace = (f * f.transpose()).trace() * std::pow(J, -2.0L / 3.0L);
  return static_cast<double>(kappa / 2 * ((J * J - 1) / 2 - std::log(J)) + mu / 2 * (trace - 3));
}

TEST_P(Law, StressIsTheDerivativeOfTheEnergy) {
  std::mt19937 rng(1);
  const double kappa = 3;
  const double mu = 2;
  const auto c = constants<double>(kappa, mu, kElastic, 1, 1);
  for (int i = 0; i < 200; ++i) {
    const Mat A = random_matrix(rng, 0.3);
    const Mat F = Mat::Identity() + A;
    const Mat tau = stress(c, deform(c, A));
    // dW(F + e D F)/de = tau : D for every velocity gradient D; central differences, error of order e^2.
    const double e = 1e-5;
    const Mat D = random_matrix(rng, 1);
    const double slope = (energy(kappa, mu, F + e * D * F) - energy(kappa, mu, F - e * D * F)) / (2 * e);
    EXPECT_NEAR(slope, tau.cwiseProduct(D).sum(), 1e-8 * (1 + tau.norm() * D.norm()));
  }
}

TEST_P(Law, StressTurnsWithTheFrame) {
  std::mt19937 rng(2);
  const auto c = constants<double>(109e3, 290, 31.9, 27.2, 0.22);
  for (int i = 0; i < 100; ++i) {
    PointState state = deform(c, random_matrix(rng, 0.2));
    const Mat before = stress(c, state);
    const Mat Q = random_rotation(rng);
    // Past rest states leave no trace of the rotation: turning the deformed body turns its stress, J and
    // yield alike.
    const PointState turned =
        deform(constants<double>(109e3, 290, kElastic, 27.2, 0.22), Q - Mat::Identity(), 1e-3, state);
    const Mat after = stress(c, turned);
    EXPECT_LT((after - Q * before * Q.transpose()).norm(), 1e-11 * (109e3 + before.norm()));
  }
}

TEST_P(Law, ElasticStrainKeepsUnitDeterminantThroughPlasticFlow) {
  std::mt19937 rng(3);
  const auto c = constants<double>(109e3, 290, 31.9, 27.2, 0.22);
  PointState state;
  for (int i = 0; i < 2000; ++i) state = deform(c, random_matrix(rng, 0.02), 1e-3, state);
  EXPECT_NEAR((Mat::Identity() + state.strain()).determinant(), 1, 1e-13);
  EXPECT_GT(state.strain().norm(), 0.05);  // it did flow
}

TEST_P(Law, SmallStrainsKeepTheirDigitsInFloat) {
  // Oobleck yields at a strain of 1e-5: steps of 1e-9 must add up, in single precision, to the exact shear.
  const auto& k = mpm::kernel_table<float>(GetParam()).point;
  const auto c = constants<float>(109e3, 11.2e3, kElastic, 10, 2.8);
  float state[7] = {};
  const float A[9] = {0, 1e-9F, 0, 0, 0, 0, 0, 0, 0};
  for (int i = 0; i < 10000; ++i) k.law_step(c, A, 1e-5F, state);
  EXPECT_NEAR(state[4], 1e-5, 1e-9);
  EXPECT_NEAR(state[0], 0, 1e-10);
}

struct ShearError {
  double stress = 0;  ///< largest of tau_xy, N1, s over the curve, over its largest s
};

ShearError shear_error(const mpm::PointKernels<double>& k, const SimpleShearRun& run, double increment) {
  const auto c = constants<double>(109e3, run.mu, run.sigma_y, run.eta, run.h);
  double state[7] = {};
  double worst = 0;
  for (std::size_t i = 1; i < run.t.size(); ++i) {
    const double span = run.t[i] - run.t[i - 1];
    const auto steps = static_cast<int>(std::ceil(span * run.shear_rate / increment * (1 - 1e-9)));
    const double dt = span / steps;
    const double A[9] = {0, run.shear_rate * dt, 0, 0, 0, 0, 0, 0, 0};
    for (int n = 0; n < steps; ++n) k.law_step(c, A, dt, state);
    double t[6];
    k.stress(c, state, t);
    const double p = (t[0] + t[1] + t[2]) / 3;
    const double s = std::sqrt((t[0] - p) * (t[0] - p) + (t[1] - p) * (t[1] - p) + (t[2] - p) * (t[2] - p) +
                               2 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
    worst = std::max(
        {worst, std::abs(t[3] - run.tau_xy[i]), std::abs(t[0] - t[1] - run.n1[i]), std::abs(s - run.s[i])});
  }
  return {worst / run.largest_s()};
}

TEST_P(Law, StartUpOfSimpleShearFollowsTheReferenceAtFirstOrder) {
  const auto runs = testing_support::simple_shear_runs();
  ASSERT_EQ(runs.size(), 15U);
  for (const SimpleShearRun& run : runs) {
    const double fine = shear_error(kernels(), run, 1e-4).stress;
    const double coarse = shear_error(kernels(), run, 4e-4).stress;
    EXPECT_LE(fine, 3e-4) << run.name();
    // First order: a quarter of the step, at most 0.29 of the error (order 0.9), until the curve's own digits
    // show.
    EXPECT_LE(fine, 0.29 * coarse + 1e-9) << run.name() << ": " << coarse << " -> " << fine;
  }
}

TEST_P(Law, EveryLaneDoesWhatTheScalarTwinDoes) {
  std::mt19937 rng(4);
  const auto& k = kernels();
  for (int i = 0; i < 64; ++i) {
    const auto c = constants<double>(109e3, 290, 31.9, 27.2, i % 2 == 0 ? 0.22 : 2.8);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> A = random_matrix(rng, 0.3);
    PointState scalar;
    PointState wide;
    const double a = k.law_step(c, A.data(), 1e-3, scalar.s);
    const double b = k.law_step_wide(c, A.data(), 1e-3, wide.s, i % 16);
    // Same operations, other exp and log (a few ulp each, times an exponent of up to 1/0.22).
    EXPECT_NEAR(a, b, 1e-13);
    for (int j = 0; j < 7; ++j) EXPECT_NEAR(scalar.s[j], wide.s[j], 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Law, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
