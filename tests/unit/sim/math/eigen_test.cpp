// Eigenvalues, eigenvectors and rotations on lanes and at single points, against their definitions.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

using Mat = Eigen::Matrix3d;

Mat random_rotation(std::mt19937& rng) {
  std::normal_distribution<double> n;
  return Eigen::Quaterniond(n(rng), n(rng), n(rng), n(rng)).normalized().toRotationMatrix();
}

/// Symmetric tensors with distinct, nearly and exactly repeated, vanishing and graded eigenvalues, some
/// diagonal, at scales from 1e-30 to 1e30.
std::vector<Mat> hard_tensors() {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Mat> out = {Mat::Zero(), Mat::Identity(), Eigen::Vector3d(3, -2, 3).asDiagonal()};
  const auto values = [&](int kind) -> Eigen::Vector3d {
    const double a = u(rng);
    const double b = u(rng);
    switch (kind) {
      case 0:
        return {a, b, u(rng)};
      case 1:
        return {a, a, b};
      case 2:
        return {a, a * (1 + 1e-6), b};
      case 3:
        return {1, 1 + 1e-7 * a, 1 + 1e-7 * b};
      case 4:
        return {1, 1e-4 * a, 1e-9 * b};
      default:
        return {a, 0, 0};
    }
  };
  for (int i = 0; i < 600; ++i) {
    const Mat Q = i % 7 == 6 ? Mat::Identity() : random_rotation(rng);
    const double size = std::pow(10.0, 10 * (i % 7) - 30);
    const Mat a = size * (Q * values(i % 6).asDiagonal() * Q.transpose());
    out.emplace_back(0.5 * (a + a.transpose()));
  }
  return out;
}

/// With a bound of a few roundings of the largest entry, whose size no permutation of operations changes.
template <class Real>
void expect_eigenpairs(const mpm::TearingKernels<Real>& kernels) {
  const double bound = 20 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  for (const Mat& exact : hard_tensors()) {
    const Eigen::Matrix<Real, 3, 3> rounded = exact.cast<Real>();
    const Real a[6] = {rounded(0, 0), rounded(1, 1), rounded(2, 2),
                       rounded(0, 1), rounded(0, 2), rounded(1, 2)};
    Eigen::Matrix<Real, 3, 1> value;
    Eigen::Matrix<Real, 3, 3, Eigen::RowMajor> vector;
    kernels.eigenpairs(a, value.data(), vector.data());
    const Mat V = vector.template cast<double>().transpose();
    const Mat& A = rounded.template cast<double>();  // in double, the tensor itself
    const double size = A.cwiseAbs().maxCoeff();
    const Mat back = V * value.template cast<double>().asDiagonal() * V.transpose();
    EXPECT_LE((back - A).cwiseAbs().maxCoeff(), bound * size) << A;
    EXPECT_LE((V.transpose() * V - Mat::Identity()).cwiseAbs().maxCoeff(), bound) << A;
    const double largest = Eigen::SelfAdjointEigenSolver<Mat>(A).eigenvalues().maxCoeff();
    EXPECT_NEAR(static_cast<double>(kernels.largest_eigenvalue(a)), largest, bound * size) << A;
  }
}

/// Increments R S - I of unit determinant: of a step, of a large strain with condition 1e4, and rotations.
template <class Real>
void expect_rotations(const mpm::TearingKernels<Real>& kernels) {
  constexpr auto eps = static_cast<double>(std::numeric_limits<Real>::epsilon());
  std::mt19937 rng(12);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 600; ++i) {
    const double strain = std::pow(10.0, i % 7 - 6) * 4.6;  // stretches to exp(4.6) = 100
    const double angle = i % 3 == 0 ? 0 : std::pow(10.0, i % 5 - 4) * 3;
    const Mat R =
        Eigen::AngleAxisd(angle * u(rng), Eigen::Vector3d(u(rng), u(rng), 1).normalized()).toRotationMatrix();
    const Mat Q = random_rotation(rng);
    const Eigen::Vector3d logs = 0.5 * strain * Eigen::Vector3d(u(rng), u(rng), u(rng));
    const Eigen::Vector3d stretches = (logs.array() - logs.mean()).exp();
    const Eigen::Matrix<Real, 3, 3, Eigen::RowMajor> A =
        (R * Q * stretches.asDiagonal() * Q.transpose() - Mat::Identity()).cast<Real>();
    Eigen::Matrix<Real, 3, 3, Eigen::RowMajor> out;
    kernels.polar_rotation(A.data(), out.data());
    // Rounding the increment by eps |A| turns its rotation by so much over the smaller stretches; the
    // iteration leaves half the square of its last change, 3e-6 at most in float.
    const double left = sizeof(Real) == 4 ? 1e-11 : 1e-15;  // that of the expected values
    const double bound = 40 * eps * A.template cast<double>().cwiseAbs().maxCoeff() / stretches.minCoeff();
    EXPECT_LE((out.template cast<double>() - (R - Mat::Identity())).cwiseAbs().maxCoeff(), bound + left)
        << "strain " << strain << " angle " << angle;
  }
}

class EigenOnLanes : public testing::TestWithParam<KernelLevel> {};

TEST_P(EigenOnLanes, PairsRebuildTheTensorAndAreOrthonormal) {
  expect_eigenpairs(mpm::kernel_table<double>(GetParam()).point.tearing_wide);
  expect_eigenpairs(mpm::kernel_table<float>(GetParam()).point.tearing_wide);
}
TEST_P(EigenOnLanes, ScalarPairsDoSoToo) {
  expect_eigenpairs(mpm::kernel_table<double>(GetParam()).point.tearing);
  expect_eigenpairs(mpm::kernel_table<float>(GetParam()).point.tearing);
}
TEST_P(EigenOnLanes, TheRotationOfAnIncrementIsFound) {
  expect_rotations(mpm::kernel_table<double>(GetParam()).point.tearing_wide);
  expect_rotations(mpm::kernel_table<float>(GetParam()).point.tearing_wide);
}
TEST_P(EigenOnLanes, TheScalarRotationToo) {
  expect_rotations(mpm::kernel_table<double>(GetParam()).point.tearing);
  expect_rotations(mpm::kernel_table<float>(GetParam()).point.tearing);
}

INSTANTIATE_TEST_SUITE_P(Levels, EigenOnLanes, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
