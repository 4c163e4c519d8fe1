// Weak points go where the grid cannot resolve what they are part of, and nowhere else. [Foam Algorithm 15]

#include "sim/mpm/resample/subgrid_removal.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <set>

#include "tests/unit/sim/mpm/resample/foam.h"

namespace lather {
namespace {

using namespace mpm::resample;  // the functions under test
using testing_support::Foam;

constexpr double kSpacing = 2;  // of the grid, in units of r

/// Cubic B-spline. [Foam E.1]
double kernel(double d) {
  const double x = std::abs(d);
  if (x >= 2) return 0;
  if (x >= 1) return (2 - x) * (2 - x) * (2 - x) / 6;
  return x * x * x / 2 - x * x + 2.0 / 3;
}

/// Ids of the points that eqs. 21 and 22 send away, over all pairs of points as the equations stand.
std::set<std::uint32_t> by_definition(const std::vector<Vec3>& points, int dimension,
                                      const SubgridRemoval& limits) {
  std::set<std::uint32_t> gone;
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::vector<std::pair<double, Vec3>> near;
    for (const Vec3& q : points) {
      double w = 1;
      for (int a = 0; a < dimension; ++a) w *= kernel((q[a] - points[p][a]) / kSpacing);
      if (w > 0) near.emplace_back(w, q);
    }
    Vec3 mean = Vec3::Zero();
    double sum = 0;
    for (const auto& [w, q] : near) mean += w * q, sum += w;
    mean /= sum;
    Mat3 v = Mat3::Zero();
    sum = 0;
    for (const auto& [w, q] : near) v += w * w * (q - mean) * (q - mean).transpose(), sum += w * w;
    v /= sum;
    const Eigen::VectorXd e =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(v.topLeftCorner(dimension, dimension)).eigenvalues();
    const double largest = e[dimension - 1];
    if (e[0] < limits.anisotropy * largest || largest < limits.extent * kSpacing * kSpacing)
      gone.insert(static_cast<std::uint32_t>(p));
  }
  return gone;
}

/// Ids that the search finds, all points being weak.
std::set<std::uint32_t> found(Foam& foam, const SubgridSearch& search, int threads = 1) {
  const PointBins bins = foam.bins();
  std::set<std::uint32_t> ids;
  for (const std::uint32_t p : find_subgrid_points(bins, foam.sets, search, threads))
    ids.insert(bins.point(p).id);
  return ids;
}

class SubgridRemovalTest : public testing::TestWithParam<int> {
 protected:
  SubgridRemovalTest() : foam_(GetParam()) {
    search_.tear_threshold = {-1, -1};  // all points are weak
    search_.mass = foam_.resampler.mass;
    search_.weights = foam_.resampler.weights;
  }
  Foam foam_;
  SubgridSearch search_;
};
INSTANTIATE_TEST_SUITE_P(Dimensions, SubgridRemovalTest, testing::Values(2, 3),
                         [](const auto& test) { return std::to_string(test.param) + "D"; });

TEST_P(SubgridRemovalTest, SpecksAndSliversGoAndWhatHasThicknessStays) {
  const int dim = GetParam();
  foam_.add({-15, -15, 0});                                         // 0: a speck
  for (int i = 0; i < 8; ++i) foam_.add({-10.0 + 0.7 * i, 10, 0});  // 1 to 8: a straight thread
  foam_.fill(Vec3::Constant(0.5), [&](const Vec3& x) {              // two layers of points
    return std::abs(x.y()) < 1 && std::abs(x.x()) < 8 && (dim == 2 || std::abs(x.z()) < 8);
  });
  std::set<std::uint32_t> expected;
  for (std::uint32_t id = 0; id < 9; ++id) expected.insert(id);
  EXPECT_EQ(found(foam_, search_), expected);
}

TEST_P(SubgridRemovalTest, PointsThatAreNotWeakStay) {
  search_.tear_threshold = {0, std::numeric_limits<double>::infinity()};
  foam_.add({-15, -15, 0});
  foam_.add({15, 15, 0}, 1);  // of a material that does not tear
  foam_.add({15, -15, 0});
  foam_.bins();
  for (std::size_t t = 0; t < foam_.sets[0].tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane)
      foam_.sets[0].values<double>(t, Field::kPlasticity)[lane] =
          foam_.sets[0].values<std::uint32_t>(t, Field::kId)[lane] == 2 ? 1e-9 : 0;
  EXPECT_EQ(found(foam_, search_), std::set<std::uint32_t>{2});
}

// The quick test for points well inside must not change the answer: clouds from sparse to full, thresholds
// from the paper's to ones that most points miss.
TEST_P(SubgridRemovalTest, FindsWhatTheEquationsSayInAnyCloud) {
  const int dim = GetParam();
  std::mt19937 rng(3);
  for (const double radius : {2.0, 4.0, 8.0}) {
    for (const double limit : {1e-5, 1e-2, 0.4}) {
      Foam foam(dim);
      std::uniform_real_distribution<double> x(-radius, radius);
      std::vector<Vec3> points;
      for (int i = 0; i < 400; ++i) {
        points.emplace_back(x(rng), x(rng), dim == 3 ? 2 * x(rng) : 0);
        foam.add(points.back());
      }
      // Positions are rounded on their way in; read back what the search sees.
      std::vector<Vec3> seen(points.size());
      const PointBins bins = foam.bins();
      for (std::size_t b = 0; b < bins.blocks().size(); ++b)
        for (std::uint32_t p = bins.first(b, 0); p < bins.last(b, bins.lattice().cells() - 1); ++p)
          seen[bins.point(p).id] = bins.lattice().world(bins.blocks()[b].block, bins.local(p));
      search_.thresholds = {1, limit, limit};
      EXPECT_EQ(found(foam, search_, 3), by_definition(seen, dim, search_.thresholds))
          << radius << " " << limit;
    }
  }
}

TEST_P(SubgridRemovalTest, RemovedPointsAreGoneAndTheirMassIsTold) {
  foam_.add({-15, -15, 0});
  foam_.add({15, 15, 0}, 1);
  const PointBins bins = foam_.bins();
  const auto gone = find_subgrid_points(bins, foam_.sets, search_, 1);
  ASSERT_EQ(gone.size(), 2U);
  EXPECT_EQ(remove_points(gone, bins, foam_.sets, search_.mass), search_.mass[0] + search_.mass[1]);
  EXPECT_TRUE(foam_.positions(0).empty());
  EXPECT_TRUE(foam_.positions(1).empty());
}

}  // namespace
}  // namespace lather
