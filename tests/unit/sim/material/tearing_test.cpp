// Tearing and recovery at single points [Foam section 7], against values of independent arithmetic and
// against the laws themselves; in both precisions, wide and scalar.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"
#include "tests/support/reference_data.h"

namespace lather {
namespace {

using testing_support::Mat9;
using testing_support::TearingCase;
using Mat = Eigen::Matrix3d;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Mat as_matrix(const Mat9& rows) {
  return Eigen::Map<const Rows>(rows.data());
}

/// A point in the precision of the kernels: differences from I are rounded, not the tensors.
template <class Real>
struct Point {
  Real state[7];  // J - 1, B xx yy zz xy xz yz
  Real G[9];      // F - I

  Point(const Mat& F, const Mat& be) {
    state[0] = static_cast<Real>(F.determinant() - 1);
    const Mat B = be - Mat::Identity();
    const double b[6] = {B(0, 0), B(1, 1), B(2, 2), B(0, 1), B(0, 2), B(1, 2)};
    for (int i = 0; i < 6; ++i) state[i + 1] = static_cast<Real>(b[i]);
    const Rows g = F - Mat::Identity();
    for (int i = 0; i < 9; ++i) G[i] = static_cast<Real>(g.data()[i]);
  }
};

template <class Real>
Mat plus_identity(const Real (&rows)[9]) {
  Rows m;
  for (int i = 0; i < 9; ++i) m.data()[i] = static_cast<double>(rows[i]);
  return m + Mat::Identity();
}

double largest(const Mat& m) {
  return m.cwiseAbs().maxCoeff();
}

/// Every figure of every case within `share` of its largest entry. A stress is compared with the stress
/// before limiting: a rounding of the pressure is no rounding of what is left when it is gone.
template <class Real>
void expect_reference(KernelLevel level, bool wide, double share) {
  const auto& point = mpm::kernel_table<Real>(level).point;
  const auto& kernels = wide ? point.tearing_wide : point.tearing;
  const auto cases = testing_support::tearing_cases();
  ASSERT_EQ(cases.size(), 55U);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const TearingCase& c = cases[n];
    SCOPED_TRACE("case " + std::to_string(n));
    const Mat F = as_matrix(c.F);
    const Point<Real> p(F, as_matrix(c.be));
    const double J = F.determinant();
    EXPECT_NEAR(static_cast<double>(kernels.plasticity(p.state, p.G)), c.plasticity, share * c.plasticity);

    // Kirchhoff stress from the state, as kernels compute it.
    const HerschelBulkleyConstants<Real> elastic{static_cast<Real>(c.kappa),
                                                 static_cast<Real>(c.mu),
                                                 std::numeric_limits<Real>::infinity(),
                                                 Real(1),
                                                 Real(1),
                                                 Real(1),
                                                 std::numeric_limits<Real>::epsilon()};
    Real tau[6];
    Real limited[6];
    point.stress(elastic, p.state, tau);
    kernels.limited_stress(tau, limited);
    Mat sigma;
    sigma << static_cast<double>(limited[0]), static_cast<double>(limited[3]),
        static_cast<double>(limited[4]), static_cast<double>(limited[3]), static_cast<double>(limited[1]),
        static_cast<double>(limited[5]), static_cast<double>(limited[4]), static_cast<double>(limited[5]),
        static_cast<double>(limited[2]);
    EXPECT_LE(largest(sigma / J - as_matrix(c.cauchy_limited)), share * largest(as_matrix(c.cauchy)));

    Real A[9];
    for (int i = 0; i < 9; ++i)
      A[i] = static_cast<Real>(c.velocity_gradient[static_cast<std::size_t>(i)] * c.dt);
    Real f[9];
    kernels.limited_increment(p.state, A, f);
    EXPECT_LE(largest(plus_identity(f) - as_matrix(c.f_limited)), share * largest(as_matrix(c.f_limited)));
    const Mat F_limited = plus_identity(f) * plus_identity(p.G);
    EXPECT_LE(largest(F_limited - as_matrix(c.F_limited)), share * largest(as_matrix(c.F_limited)));

    Real state[7];
    std::copy_n(p.state, 7, state);
    point.law_step(elastic, f, static_cast<Real>(c.dt), state);
    const Mat be = as_matrix(c.be_pre_limited);
    const double b[6] = {be(0, 0) - 1, be(1, 1) - 1, be(2, 2) - 1, be(0, 1), be(0, 2), be(1, 2)};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(static_cast<double>(state[i + 1]), b[i], share * largest(be));

    Real recovered[9];
    const auto exponent = static_cast<Real>(0.5 * std::expm1(-c.dt / c.recovery_time));
    kernels.recovered(p.state, p.G, exponent, recovered);
    EXPECT_LE(largest(plus_identity(recovered) - as_matrix(c.F_recovered)),
              share * largest(as_matrix(c.F_recovered)));
  }
}

class Tearing : public testing::TestWithParam<KernelLevel> {};

TEST_P(Tearing, DoubleMeetsAllReferenceCases) {
  expect_reference<double>(GetParam(), true, 1e-9);
}
TEST_P(Tearing, FloatMeetsAllReferenceCases) {
  expect_reference<float>(GetParam(), true, 1e-4);
}
TEST_P(Tearing, ScalarTwinMeetsThemToo) {
  expect_reference<double>(GetParam(), false, 1e-9);
  expect_reference<float>(GetParam(), false, 1e-4);
}

/// A plastic stretch without elastic strain, C^p = Q diag(stretch^2) Q^T of unit determinant.
template <class Real>
Point<Real> stretched(const Eigen::Vector3d& logs, const Mat& Q) {
  const Eigen::Vector3d stretch = (logs.array() - logs.mean()).exp();
  const Mat R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return {R * Q * stretch.asDiagonal() * Q.transpose(), Mat::Identity()};
}

const Mat kOblique = Eigen::AngleAxisd(1.1, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix();

/// Stretches fade as lambda0^exp(-t/eta_p), whatever the parts in which time passes, and det F stays.
template <class Real>
void expect_fading(KernelLevel level, double bound) {
  const auto& kernels = mpm::kernel_table<Real>(level).point.tearing_wide;
  constexpr double kRecoveryTime = 0.35;
  constexpr int kParts = 1000;
  for (const Eigen::Vector3d& logs : {Eigen::Vector3d(1.2, 0.1, -0.9), Eigen::Vector3d(0.5, 0.5, -1),
                                      Eigen::Vector3d(2.5, -1.25, -1.25), Eigen::Vector3d(1e-3, 0, 0)}) {
    Point<Real> p = stretched<Real>(logs, kOblique);
    const double det = plus_identity(p.G).determinant();
    const double t = 0.5 * kRecoveryTime;
    const auto exponent = static_cast<Real>(0.5 * std::expm1(-t / kParts / kRecoveryTime));
    for (int i = 0; i < kParts; ++i) {
      Real next[9];
      kernels.recovered(p.state, p.G, exponent, next);
      std::copy_n(next, 9, p.G);
    }
    const Eigen::Vector3d after = Eigen::JacobiSVD<Mat>(plus_identity(p.G)).singularValues();
    Eigen::Vector3d expected = ((logs.array() - logs.mean()) * std::exp(-t / kRecoveryTime)).exp();
    std::sort(expected.data(), expected.data() + 3, std::greater<>());
    EXPECT_LE((after - expected).cwiseAbs().maxCoeff(), bound * expected.maxCoeff()) << logs.transpose();
    EXPECT_NEAR(plus_identity(p.G).determinant(), det, bound) << logs.transpose();
  }
}

TEST_P(Tearing, StretchesFadeExponentiallyInTheirLogarithmAndKeepTheVolume) {
  expect_fading<double>(GetParam(), 1e-11);  // 1000 roundings of an exponent of 5e-4 and of F
  expect_fading<float>(GetParam(), 2e-4);    // the same; they add up in one direction at worst
}

TEST_P(Tearing, RecoveryStaysFiniteAndKeepsTheVolumeAtAnyStretch) {
  // C^p to 1e12 in float: its small eigenvalues are lost in the rounding of the large ones.
  const auto& kernels = mpm::kernel_table<float>(GetParam()).point.tearing_wide;
  for (const double log : {1.0, 4.0, 8.0, 14.0}) {
    const Point<float> p = stretched<float>({log, 0, -log}, kOblique);
    float out[9];
    kernels.recovered(p.state, p.G, -5e-4F, out);
    for (const float x : out) EXPECT_TRUE(std::isfinite(x)) << log;
    const double before = largest(plus_identity(p.G));
    EXPECT_NEAR(largest(plus_identity(out)) / before, std::exp(-1e-3 * log), 1e-4) << log;
  }
}

TEST_P(Tearing, AnUndeformedPointIsNotPlasticAndAnElasticDeformationIsNone) {
  const auto& kernels = mpm::kernel_table<float>(GetParam()).point.tearing_wide;
  const Point<float> rest(Mat::Identity(), Mat::Identity());
  EXPECT_EQ(kernels.plasticity(rest.state, rest.G), 0);
  Mat F;
  F << 1.02, 0.01, 0, -0.03, 1.01, 0.02, 0.005, 0, 0.98;
  const Mat be = F * F.transpose() * std::pow(F.determinant(), -2.0 / 3);
  const Point<float> elastic(F, be);
  EXPECT_LE(kernels.plasticity(elastic.state, elastic.G), 1e-7F);  // C^p is I to a rounding of the strain
}

TEST_P(Tearing, AWeakPointIsCompressedAsAnyOther) {
  const auto& kernels = mpm::kernel_table<double>(GetParam()).point.tearing_wide;
  const Point<double> p(0.95 * Mat::Identity(), Mat::Identity());
  double A[9] = {-1e-3, 0, 0, 0, -1e-3, 0, 0, 0, -1e-3};
  double out[9];
  kernels.limited_increment(p.state, A, out);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(out[i], A[i], 1e-17);
  const double tau[6] = {-3, -1, -2, 0.1, 0.2, 0.3};  // all eigenvalues negative
  double limited[6];
  kernels.limited_stress(tau, limited);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(limited[i], tau[i], 1e-14);
}

/// F and state in float after `steps` equal steps of an elastic point, turned by `turn` in each (radians) and
/// sheared to and fro by up to `shear`.
Point<float> turned_and_sheared(const mpm::PointKernels<float>& kernels, int steps, double turn,
                                double shear) {
  const HerschelBulkleyConstants<float> elastic{1, 1,      std::numeric_limits<float>::infinity(), 1, 1,
                                                1, 1.2e-7F};
  Point<float> p(Mat::Identity(), Mat::Identity());
  for (int step = 0; step < steps; ++step) {
    const double s = shear * std::cos(2e-3 * step);
    const double a[9] = {0.1 * s, s - turn, 0, turn, 0, 0, 0, 0.5 * s, 0};
    float A[9];
    std::copy_n(a, 9, A);
    kernels.law_step(elastic, A, 1e-5F, p.state);
    float next[9];
    kernels.tearing.deformed(p.G, A, next);
    std::copy_n(next, 9, p.G);
  }
  return p;
}

TEST_P(Tearing, DeformationAgreesWithTheVolumeRatioOverManySteps) {
  // A second of a shake at steps of 1e-5 s. Roundings of F by 3e-8 that cancel as if by chance add up to
  // 1e-5, those that do not to 3e-3.
  const auto& kernels = mpm::kernel_table<float>(GetParam()).point;
  const Point<float> p = turned_and_sheared(kernels, 100'000, 2e-5, 3e-5);
  const double J = 1 + static_cast<double>(p.state[0]);
  EXPECT_GT(largest(plus_identity(p.G) - Mat::Identity()), 0.5);  // it went somewhere
  EXPECT_NEAR(plus_identity(p.G).determinant() / J, 1, 3e-4);
  EXPECT_LE(kernels.tearing.plasticity(p.state, p.G), 3e-4F);  // elastic: what there is is rounding
}

TEST_P(Tearing, AFlowOfAMillimetrePerSecondAndMetreArrives) {
  // Each step stretches by 1e-8, below what a float F of about 1 can tell apart.
  const auto& kernels = mpm::kernel_table<float>(GetParam()).point;
  Point<float> p(Mat::Identity(), Mat::Identity());
  const float A[9] = {1e-8F, 0, 0, 0, -1e-8F, 0, 0, 0, 0};
  for (int step = 0; step < 100'000; ++step) {
    float next[9];
    kernels.tearing.deformed(p.G, A, next);
    std::copy_n(next, 9, p.G);
  }
  EXPECT_NEAR(p.G[0], 1e-3, 1e-5);
  EXPECT_NEAR(p.G[4], -1e-3, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Levels, Tearing, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
