// Forces, and gradients of velocities, between points [MLSRK eq. 11, 12, 18].

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/sim/mlsrk/arrangement.h"

namespace lather {
namespace {

using testing_support::Arrangement;

class Exchange : public testing::TestWithParam<int> {
 protected:
  Arrangement<double> arrangement(double regularization = 0) const {
    Arrangement<double> points(GetParam(),
                               mlsrk::kernel_table<double>(best_kernel_level()).wide[GetParam() - 2][1][0]);
    points.fill(GetParam() == 3 ? 5 : 8, 0.7, 0.2, 3);
    points.compute({regularization, 0, 1e-10});
    return points;
  }
  [[nodiscard]] std::vector<std::array<double, 6>> random_stress(std::size_t n) const {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    std::vector<std::array<double, 6>> stress(n);
    for (auto& s : stress) {
      for (double& c : s) c = normal(random);
      if (GetParam() == 2) s[2] = s[4] = s[5] = 0;
    }
    return stress;
  }
};

TEST_P(Exchange, AnAffineFlowHasItsGradientAndIsItsOwnSmoothVelocity) {
  auto points = arrangement();
  Mat3 L;
  L << 1, 2, -1, 0.5, -0.3, 0.7, 0.2, -0.9, 1.1;
  if (GetParam() == 2) L.row(2).setZero(), L.col(2).setZero();
  std::vector<Vec3> u;
  for (std::size_t i = 0; i < points.size(); ++i) u.emplace_back(L * points.x(i) + Vec3(5, -3, 0));
  std::vector<Mat3> gradient;
  std::vector<Vec3> smooth;
  points.differentiate(u, gradient, smooth);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((gradient[i] - L).norm(), 1e-8);
    EXPECT_LT(smooth[i].norm(), 1e-9);
  }
}

// What sum_j N_j u_j and sum_j grad N_j (x) u_j come to with the functions taken one by one.
TEST_P(Exchange, WithARegularizedConstantACommonVelocityIsDragged) {
  Arrangement<double> points(GetParam(),
                             mlsrk::kernel_table<double>(best_kernel_level()).wide[GetParam() - 2][1][0]);
  points.fill(GetParam() == 3 ? 5 : 8, 0.7, 0.2, 3);
  points.compute({1e-2, 1e-2, 1e-10});
  const Vec3 u(5, -3, GetParam() == 3 ? 2 : 0);
  std::vector<Mat3> gradient;
  std::vector<Vec3> smooth;
  points.differentiate(std::vector<Vec3>(points.size(), u), gradient, smooth);
  for (std::size_t i = 0; i < points.size(); i += 7) {
    double one = 0;
    Vec3 slope = Vec3::Zero();
    for (std::size_t j = 0; j < points.size(); ++j) {
      const auto n = points.shape_function(j, i, 1, false);
      one += n.value;
      slope += n.gradient;
    }
    EXPECT_LT(one, 1);
    EXPECT_LT((smooth[i] - (one - 1) * u).norm(), 1e-12);
    EXPECT_LT((gradient[i] - u * slope.transpose()).norm(), 1e-10);
  }
}

// Single precision: a common fall of 100 m/s leaves no trace, for only differences are summed.
TEST(ExchangeInFloat, ACommonVelocityHasNoGradient) {
  Arrangement<float> points(3, mlsrk::kernel_table<float>(best_kernel_level()).wide[1][1][0]);
  points.fill(5, 0.7, 0.2, 3);
  points.compute({1e-3F, 0, 1e-5F});
  std::vector<Mat3> gradient;
  std::vector<Vec3> smooth;
  points.differentiate(std::vector<Vec3>(points.size(), Vec3(0, -100, 0)), gradient, smooth);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(gradient[i].norm(), 0);
    EXPECT_EQ(smooth[i].norm(), 0);
  }
}

// sum_i grad N_i(x_j) = 0, whatever r: with their own masses the points keep sum m u.
TEST_P(Exchange, ForcesAddUpToNothing) {
  for (const double r : {0.0, 1e-3, 1.0}) {
    auto points = arrangement(r);
    const std::vector<double> mass(points.size(), 2.0);
    const auto u = points.accelerate(random_stress(points.size()), mass, 1, true);
    Vec3 momentum = Vec3::Zero();
    double size = 0;
    for (const Vec3& v : u) momentum += 2 * v, size += 2 * v.norm();
    EXPECT_LT(momentum.norm(), 1e-12 * size);
  }
}

// [MLSRK eq. 11] sums the same terms that shape_function() gives one by one.
TEST_P(Exchange, ForcesAndLumpedMassesAreTheSumsOfTheEquation) {
  auto points = arrangement(1e-3);
  const auto stress = random_stress(points.size());
  std::vector<double> mass(points.size());
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = 1 + 0.1 * static_cast<double>(i % 7);
  const double dt = 0.5;
  const auto u = points.accelerate(stress, mass, dt, false);
  for (std::size_t i = 0; i < points.size(); i += 5) {
    Vec3 f = Vec3::Zero();
    double lumped = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const auto n = points.shape_function(i, j, 1, false);
      const auto& s = stress[j];
      Mat3 S;
      S << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
      f -= S * n.gradient;
      lumped += n.value * mass[j];
    }
    const double divisor = lumped >= 0.1 * mass[i] ? lumped : mass[i];
    EXPECT_LT((u[i] - dt / divisor * f).norm(), 1e-10 * (1 + u[i].norm()));
  }
}

// A uniform stress pulls at no point whose whole neighbourhood has its full consistency: an integral of a
// gradient over the support; on a lattice, inside, it vanishes to rounding by symmetry.
TEST(ExchangeOnALattice, AUniformStressMovesNoInteriorPoint) {
  Arrangement<double> points(2, mlsrk::kernel_table<double>(best_kernel_level()).wide[0][1][0]);
  points.fill(16, 0.7, 0, 1);
  points.compute({0, 0, 1e-10});
  const std::vector<std::array<double, 6>> stress(points.size(), {1, 2, 0, 0.5, 0, 0});
  const auto u = points.accelerate(stress, std::vector<double>(points.size(), 1), 1, false);
  const std::size_t middle = 8 * 17 + 8;
  EXPECT_LT(u[middle].norm(), 1e-12);
  EXPECT_GT(u[0].norm(), 0.1);  // the corner is pulled
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Exchange, testing::Values(2, 3),
                         [](const auto& c) { return std::to_string(c.param) + "D"; });

}  // namespace
}  // namespace lather
