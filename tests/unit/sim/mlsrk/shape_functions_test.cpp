// What the shape functions promise [MLSRK section 3.2, Appendix A], on lattices and jittered points, inside
// and at the edge.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "tests/unit/sim/mlsrk/arrangement.h"

namespace lather {
namespace {

using testing_support::Arrangement;

/// dimension, order of the basis, radial kernel, jitter over the distance of the points
using Case = std::tuple<int, int, bool, double>;

class ShapeFunctions : public testing::TestWithParam<Case> {
 protected:
  // Points 0.7 a apart, so that R = 2.86 d: enough neighbours for the quadratic basis at a corner in 3D.
  template <class Real>
  Arrangement<Real> arrangement(Real regularization, Real constant = 0) const {
    const auto [dimension, order, radial, jitter] = GetParam();
    Arrangement<Real> points(dimension, kernels<Real>());
    points.fill(dimension == 3 ? 5 : 8, 0.7, jitter, 1);
    points.compute({regularization, constant, sizeof(Real) == 4 ? Real(1e-5) : Real(1e-10)});
    return points;
  }
  template <class Real>
  const mlsrk::Kernels<Real>& kernels() const {
    const auto [dimension, order, radial, jitter] = GetParam();
    return mlsrk::kernel_table<Real>(best_kernel_level()).wide[dimension - 2][order][radial ? 1 : 0];
  }
  [[nodiscard]] int order() const { return std::get<1>(GetParam()); }
  [[nodiscard]] bool radial() const { return std::get<2>(GetParam()); }
  [[nodiscard]] int dimension() const { return std::get<0>(GetParam()); }
};

class LinearShapeFunctions : public ShapeFunctions {};
class QuadraticShapeFunctions : public ShapeFunctions {};

/// sum_j N_j(x_i) f(x_j) and sum_j grad N_j(x_i) f(x_j).
template <class Real, class Function>
typename Arrangement<Real>::Function interpolate(const Arrangement<Real>& points, std::size_t i, int order,
                                                 bool radial, const Function& f) {
  typename Arrangement<Real>::Function sum{0, Vec3::Zero()};
  for (std::size_t j = 0; j < points.size(); ++j) {
    const auto n = points.shape_function(j, i, order, radial);
    sum.value += n.value * f(points.x(j));
    sum.gradient += n.gradient * f(points.x(j));
  }
  return sum;
}

// Sums of some hundred terms of order 1 over a moment matrix whose condition is some thousand at a corner of
// the quadratic basis: 1e-10 leaves three digits to spare.
TEST_P(ShapeFunctions, ReproduceConstantsWithAnyRegularization) {
  for (const double r : {0.0, 1e-3, 1.0}) {
    const auto points = arrangement<double>(r);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto one = interpolate(points, i, order(), radial(), [](const Vec3&) { return 1.0; });
      EXPECT_NEAR(one.value, 1, 1e-10);
      EXPECT_LT(one.gradient.norm(), 1e-9);
    }
  }
}

TEST_P(ShapeFunctions, LoseConstantsWhereTheConstantIsRegularized) {
  const auto points = arrangement<double>(1e-3, 1e-1);
  const auto one = interpolate(points, 0, order(), radial(), [](const Vec3&) { return 1.0; });
  EXPECT_LT(one.value, 0.99);
}

TEST_P(LinearShapeFunctions, ReproduceLinearFieldsAndTheirGradients) {
  const auto points = arrangement<double>(0);
  const Vec3 slope(0.7, -1.3, dimension() == 3 ? 0.4 : 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_FALSE(points.fallen(i));
    const auto f = interpolate(points, i, order(), radial(), [&](const Vec3& x) { return slope.dot(x) + 2; });
    EXPECT_NEAR(f.value, slope.dot(points.x(i)) + 2, 1e-9);
    EXPECT_LT((f.gradient - slope).norm(), 1e-8);
  }
}

// sum_j grad N_j(x) (x) (x_j - x) = I: the gradient of every linear field at once.
TEST_P(LinearShapeFunctions, HaveTheFirstMomentOfTheirGradientsOne) {
  const auto points = arrangement<double>(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Mat3 moment = Mat3::Zero();
    for (std::size_t j = 0; j < points.size(); ++j)
      moment +=
          points.shape_function(j, i, order(), radial()).gradient * (points.x(j) - points.x(i)).transpose();
    if (dimension() == 2) moment(2, 2) = 1;
    EXPECT_LT((moment - Mat3::Identity()).norm(), 1e-8);
  }
}

TEST_P(QuadraticShapeFunctions, ReproduceQuadraticFieldsAndTheirGradients) {
  const auto points = arrangement<double>(0);
  Mat3 H;
  H << 1, 0.3, -0.2, 0.3, -0.5, 0.8, -0.2, 0.8, 0.6;
  if (dimension() == 2) H.row(2).setZero(), H.col(2).setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_FALSE(points.fallen(i));
    const Vec3 center = points.x(i);
    const auto f = interpolate(points, i, order(), radial(), [&](const Vec3& x) { return x.dot(H * x); });
    EXPECT_NEAR(f.value, center.dot(H * center), 1e-8);
    EXPECT_LT((f.gradient - 2 * H * center).norm(), 1e-7);
  }
}

// The gradient against central differences of N itself, recomputed with the target moved. Their error is
// delta^2/6 of a third derivative of order 10, and eps/delta: about 1e-7 in all.
TEST_P(ShapeFunctions, HaveTheGradientThatDifferencesShow) {
  const double delta = 1e-4;
  for (const double r : {0.0, 1e-2}) {
    for (const double constant : {0.0, 1e-2}) {
      for (int a = 0; a < dimension(); ++a) {
        Arrangement<double> points(dimension(), kernels<double>());
        const Vec3 middle(1.31, 1.52, dimension() == 3 ? 1.17 : 0);
        for (const double move : {0.0, delta, -delta}) points.add(middle + move * Vec3::Unit(a), 0);
        points.fill(dimension() == 3 ? 4 : 5, 0.7, std::get<3>(GetParam()), 2);
        points.compute({r, constant, 1e-10});
        for (std::size_t j = 3; j < points.size(); ++j) {
          const double up = points.shape_function(j, 1, order(), radial()).value;
          const double down = points.shape_function(j, 2, order(), radial()).value;
          EXPECT_NEAR(points.shape_function(j, 0, order(), radial()).gradient[a], (up - down) / (2 * delta),
                      1e-6);
        }
      }
    }
  }
}

// Both add in the same order; what differs is the contraction of products into sums.
TEST_P(ShapeFunctions, AreTheSameOnLanesAndPointByPoint) {
  const auto [dimension, order, radial, jitter] = GetParam();
  const auto wide = arrangement<float>(1e-3F);
  Arrangement<float> single(
      dimension, mlsrk::kernel_table<float>(best_kernel_level()).scalar[dimension - 2][order][radial]);
  single.fill(dimension == 3 ? 5 : 8, 0.7, jitter, 1);
  single.compute({1e-3F, 0, 1e-5F});
  ASSERT_EQ(wide.shape().size(), single.shape().size());
  float largest = 0;
  for (const float s : single.shape()) largest = std::max(largest, std::abs(s));
  for (std::size_t k = 0; k < single.shape().size(); ++k)
    EXPECT_NEAR(wide.shape()[k], single.shape()[k], 1e-4F * largest);
}

std::string case_name(const testing::TestParamInfo<Case>& c) {
  const auto [dimension, order, radial, jitter] = c.param;
  return std::to_string(dimension) + "D_order" + std::to_string(order) + (radial ? "_radial" : "_tensor") +
         (jitter == 0  ? "_lattice"
          : jitter < 1 ? "_jittered"
                       : "_random");
}

/// Points anywhere within their distance of a lattice's: no order is left.
constexpr double kRandom = 1;

auto cases(const std::vector<int>& orders) {
  return testing::Combine(testing::Values(2, 3), testing::ValuesIn(orders), testing::Bool(),
                          testing::Values(0.0, 0.2, kRandom));
}

INSTANTIATE_TEST_SUITE_P(All, ShapeFunctions, cases({0, 1, 2}), case_name);
INSTANTIATE_TEST_SUITE_P(All, LinearShapeFunctions, cases({1, 2}), case_name);
INSTANTIATE_TEST_SUITE_P(All, QuadraticShapeFunctions, cases({2}), case_name);

TEST(ShapeFunctionsAlone, OfAnIsolatedPointAreFiniteAndOne) {
  for (int dimension : {2, 3})
    for (int order : {0, 1, 2})
      for (const double r : {0.0, 1e-3}) {
        Arrangement<double> points(
            dimension, mlsrk::kernel_table<double>(best_kernel_level()).wide[dimension - 2][order][0]);
        points.add(Vec3::Zero(), 0.3);
        points.compute({r, 0, 1e-10});
        EXPECT_NEAR(points.shape_function(0, 0, order, false).value, 1, 1e-12);
        EXPECT_LT(points.shape_function(0, 0, order, false).gradient.norm(), 1e-12);
        EXPECT_EQ(points.fallen(0), order > 0 && r == 0);
      }
}

// Points in a plane, all that a sheet has without thickness: r = 0 cannot invert and falls back.
TEST(ShapeFunctionsAlone, OfASheetFallBackAndReproduceFieldsInItsPlane) {
  Arrangement<double> points(3, mlsrk::kernel_table<double>(best_kernel_level()).wide[1][1][0]);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) points.add(Vec3(0.7 * i, 0.7 * j, 0), 0.3);
  points.compute({0, 0, 1e-8});
  const std::size_t middle = 27;
  ASSERT_TRUE(points.fallen(middle));
  const auto f = interpolate(points, middle, 1, false, [](const Vec3& x) { return x.x() - 2 * x.y(); });
  // r = 1e-8 on terms whose moments are of order 1
  EXPECT_NEAR(f.value, points.x(middle).x() - 2 * points.x(middle).y(), 1e-6);
  EXPECT_LT((f.gradient - Vec3(1, -2, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace lather
