// Tearing and recovery of single points [Foam section 7], where closed forms exist.
//
// Recovery: a plastic stretch lambda fades as lambda(t) = lambda0^exp(-t/eta_p) and the volume stays, det R =
// 1 [Foam Algorithm 14]. Limited stress: Q diag(min(0, t)) Q^T of Q diag(t) Q^T [Foam Algorithm 8]. Limited
// increment: of R U with R a rotation and U a stretch, an undeformed weak point keeps R and U's volume; one
// that has expanded keeps R alone [Foam Algorithm 11]. Plasticity: |dev diag(lambda^2)| of the stretches
// lambda [Foam Algorithm 7].

#include "sim/study/verify/tearing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sim/mpm/levels.h"

namespace lather::study {
namespace {

using Mat = Eigen::Matrix3d;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vec = Eigen::Vector3d;

const Mat kQ = Eigen::AngleAxisd(1.1, Vec(3, -1, 2).normalized()).toRotationMatrix();
const Mat kR = Eigen::AngleAxisd(0.02, Vec(1, 2, -1).normalized()).toRotationMatrix();

/// Worst errors, relative to the largest entry of what should come out.
struct Errors {
  double fading = 0;
  double volume = 0;
  double plasticity = 0;
  double stress = 0;
  double increment = 0;
};

double largest(const Mat& m) {
  return m.cwiseAbs().maxCoeff();
}

/// Tensors as the kernels take and give them, in their precision: differences from I, row by row.
template <class Real>
class Point {
 public:
  explicit Point(const Mat& F) {
    set(F, G);
    state[0] = static_cast<Real>(F.determinant() - 1);
  }

  static void set(const Mat& m, Real* rows) {
    const Rows difference = m - Mat::Identity();
    std::transform(difference.data(), difference.data() + 9, rows,
                   [](double x) { return static_cast<Real>(x); });
  }
  static Mat get(const Real* rows) {
    Rows m;
    std::copy_n(rows, 9, m.data());
    return m + Mat::Identity();
  }

  Real state[7] = {};  ///< J - 1, B xx yy zz xy xz yz: without elastic strain
  Real G[9];           ///< F - I
};

/// `logs` of the stretches, whose sum is 0, fade over half of the recovery time in a thousand parts.
template <class Real>
void recover(const mpm::TearingKernels<Real>& kernels, const Vec& logs, Errors& errors) {
  constexpr double kRecoveryTime = 0.35;  // s
  constexpr double kTime = 0.5 * kRecoveryTime;
  constexpr int kParts = 1000;
  const Vec stretch = logs.array().exp();
  Point<Real> p(kR * kQ * stretch.asDiagonal() * kQ.transpose());
  const Mat before = Point<Real>::get(p.G);

  const Mat C = stretch.array().square().matrix().asDiagonal();
  const double exact = (C - C.trace() / 3 * Mat::Identity()).norm();
  const double got = static_cast<double>(kernels.plasticity(p.state, p.G));
  errors.plasticity = std::max(errors.plasticity, std::abs(got - exact) / largest(C));

  const auto exponent = static_cast<Real>(0.5 * std::expm1(-kTime / kParts / kRecoveryTime));
  for (int i = 0; i < kParts; ++i) {
    Real next[9];
    kernels.recovered(p.state, p.G, exponent, next);
    std::copy_n(next, 9, p.G);
  }
  const Vec faded = (logs * std::exp(-kTime / kRecoveryTime)).array().exp();
  const Mat want = kR * kQ * faded.asDiagonal() * kQ.transpose();
  const Mat after = Point<Real>::get(p.G);
  errors.fading = std::max(errors.fading, largest(after - want) / largest(want));
  errors.volume = std::max(errors.volume, std::abs(after.determinant() / before.determinant() - 1));
}

template <class Real>
void limit_stress(const mpm::TearingKernels<Real>& kernels, const Vec& stress, Errors& errors) {
  const Mat sigma = kQ * stress.asDiagonal() * kQ.transpose();
  const Mat want = kQ * stress.cwiseMin(0).asDiagonal() * kQ.transpose();
  const int row[6] = {0, 1, 2, 0, 0, 1};
  const int column[6] = {0, 1, 2, 1, 2, 2};
  Real tau[6];
  Real limited[6];
  for (int i = 0; i < 6; ++i) tau[i] = static_cast<Real>(sigma(row[i], column[i]));
  kernels.limited_stress(tau, limited);
  for (int i = 0; i < 6; ++i) {
    const double error = std::abs(static_cast<double>(limited[i]) - want(row[i], column[i]));
    errors.stress = std::max(errors.stress, error / largest(sigma));
  }
}

/// `volume` of the point, and `growth` of it in the increment.
template <class Real>
void limit_increment(const mpm::TearingKernels<Real>& kernels, double volume, double growth, Errors& errors) {
  const Vec logs(0.02, -0.005, -0.015);
  const double length = std::cbrt(growth);
  const Vec stretch = logs.array().exp() * length;
  const Point<Real> p(std::cbrt(volume) * Mat::Identity());
  Real A[9];
  Real limited[9];
  Point<Real>::set(kR * kQ * stretch.asDiagonal() * kQ.transpose(), A);
  kernels.limited_increment(p.state, A, limited);
  const Mat want = volume > 1 && growth > 1 ? kR : Mat(length * kR);
  errors.increment = std::max(errors.increment, largest(Point<Real>::get(limited) - want));
}

template <class Real>
Errors worst_errors() {
  const auto& kernels = mpm::kernel_table<Real>(best_kernel_level()).point.tearing_wide;
  Errors errors;
  for (const Vec& logs : {Vec(1.2, 0.1, -1.3), Vec(0.5, 0.5, -1), Vec(1, -0.5, -0.5), Vec(1e-3, 0, -1e-3)})
    recover(kernels, logs, errors);
  for (const Vec& stress : {Vec(3, -1, -2), Vec(2, 1, -2), Vec(-3, -1, -2), Vec(3, 3, -2), Vec(1, 2, 3)})
    limit_stress(kernels, stress, errors);
  for (const double volume : {0.98, 1.02})
    for (const double growth : {0.99, 1.01}) limit_increment(kernels, volume, growth, errors);
  return errors;
}

/// Some ten roundings of the largest entry; over the thousand parts of recovery they add up as if by chance,
/// to some thirty.
template <class Real>
void add_findings(const std::string& precision, std::vector<Finding>& findings) {
  const double rounding = std::numeric_limits<Real>::epsilon();
  const Errors errors = worst_errors<Real>();
  findings.push_back({"lambda0^exp(-t/eta_p), " + precision, errors.fading, 30 * rounding});
  findings.push_back({"det R = 1 over 1000 recoveries, " + precision, errors.volume, 30 * rounding});
  findings.push_back(
      {"plasticity, over the largest eigenvalue, " + precision, errors.plasticity, 10 * rounding});
  findings.push_back({"limited stress, over the stress, " + precision, errors.stress, 10 * rounding});
  findings.push_back({"limited increment, " + precision, errors.increment, 10 * rounding});
}

}  // namespace

std::vector<Finding> verify_tearing(int /*threads*/) {
  std::vector<Finding> findings;
  add_findings<double>("double", findings);
  add_findings<float>("single precision", findings);
  return findings;
}

}  // namespace lather::study
