// Points find each neighbour once, and lanes sum what single points do, at every kernel level.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/kernel_levels.h"
#include "tests/unit/sim/mlsrk/arrangement.h"

namespace lather {
namespace {

using testing_support::Arrangement;

double spline(double s) {
  const double q = std::max(2 - std::abs(s), 0.0);
  const double p = std::max(1 - std::abs(s), 0.0);
  return q * q * q / 6 - p * p * p * 2 / 3;
}

double phi(const Vec3& xi, int dimension, bool radial) {
  if (radial) return spline(xi.norm());
  double product = 1;
  for (int a = 0; a < dimension; ++a) product *= spline(xi[a]);
  return product;
}

class Nearby : public testing::TestWithParam<KernelLevel> {
 protected:
  /// Calls check(table, dimension, radial) for both dimensions and kernels.
  template <class Real, class Check>
  static void for_kernels(const Check& check) {
    for (const int dimension : {2, 3})
      for (const bool radial : {false, true}) check(mlsrk::kernel_table<Real>(GetParam()), dimension, radial);
  }
  /// Some hundred points anywhere, the last tile with empty lanes.
  template <class Real>
  static Arrangement<Real> scattered(int dimension, const mlsrk::Kernels<Real>& kernels) {
    Arrangement<Real> points(dimension, kernels);
    points.fill(dimension == 3 ? 6 : 18, 0.7, 1, 5);
    points.compute({Real(1e-3), 0, sizeof(Real) == 4 ? Real(1e-5) : Real(1e-10)});
    EXPECT_NE(points.size() % kTile, 0U);
    return points;
  }

  // Up to 300 terms of at most 1, each rounded a few times.
  template <class Real>
  static void expect_all_counted() {
    const double bound = 300 * 3 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    for_kernels<Real>([&](const mlsrk::KernelTable<Real>& table, int dimension, bool radial) {
      const auto points = scattered<Real>(dimension, table.wide[dimension - 2][1][radial]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < points.size(); ++j)
          sum += phi(points.x(j) - points.x(i), dimension, radial);
        EXPECT_NEAR(points.crowding(i), sum, bound) << dimension << " " << radial << " " << i;
      }
    });
  }

  // The same terms, rounded and added in another order; where the moment matrix has small pivots (1e-3 by its
  // regularisation) the corrections take on a thousand times that.
  template <class Real>
  static void expect_the_same_from_lanes_and_points() {
    const double bound = 1e4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    for_kernels<Real>([&](const mlsrk::KernelTable<Real>& table, int dimension, bool radial) {
      auto lanes = scattered<Real>(dimension, table.wide[dimension - 2][1][radial]);
      auto single = scattered<Real>(dimension, table.scalar[dimension - 2][1][radial]);
      std::mt19937 random(6);
      std::normal_distribution<double> normal;
      std::vector<Vec3> u(lanes.size());
      std::vector<std::array<double, 6>> stress(lanes.size());
      std::vector<double> mass(lanes.size());
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        u[i] = {normal(random), normal(random), dimension == 3 ? normal(random) : 0};
        for (double& s : stress[i]) s = normal(random);
        mass[i] = 1 + std::abs(normal(random));
      }
      std::vector<Mat3> gradient[2];
      std::vector<Vec3> smooth[2];
      lanes.differentiate(u, gradient[0], smooth[0]);
      single.differentiate(u, gradient[1], smooth[1]);
      const auto pushed = lanes.accelerate(stress, mass, 1, true);
      const auto pushed_singly = single.accelerate(stress, mass, 1, true);
      double largest[3] = {};
      for (std::size_t i = 0; i < u.size(); ++i) {
        largest[0] = std::max(largest[0], gradient[1][i].norm());
        largest[1] = std::max(largest[1], smooth[1][i].norm());
        largest[2] = std::max(largest[2], pushed_singly[i].norm());
      }
      for (std::size_t i = 0; i < u.size(); ++i) {
        EXPECT_LE((gradient[0][i] - gradient[1][i]).norm(), bound * largest[0]) << i;
        EXPECT_LE((smooth[0][i] - smooth[1][i]).norm(), bound * largest[1]) << i;
        EXPECT_LE((pushed[i] - pushed_singly[i]).norm(), bound * largest[2]) << i;
      }
    });
  }
};

TEST_P(Nearby, EveryNeighbourCountsOnce) {
  expect_all_counted<float>();
  expect_all_counted<double>();
}

TEST_P(Nearby, LanesSumWhatSinglePointsDo) {
  expect_the_same_from_lanes_and_points<float>();
  expect_the_same_from_lanes_and_points<double>();
}

INSTANTIATE_TEST_SUITE_P(Levels, Nearby, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
