// The distance from the foam's surface against a slow twin that knows no blocks. [Foam Algorithm 2]

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/sim/mpm/resample/foam.h"

namespace lather {
namespace {

using mpm::resample::PointBins;
using mpm::resample::SignedDistance;
using testing_support::Foam;

/// Algorithm 2 by brute force on the nodes around one point: (0, 0, 0) is the lattice's node nearest to the
/// middle.
class Twin {
 public:
  Twin(const std::vector<Vec3>& points, int dimension, int size)
      : size_(size), z_(dimension == 3 ? size : 0) {
    for_nodes([&](const Vec3& x) {
      double nearest = 1e30;
      for (const Vec3& p : points) nearest = std::min(nearest, (p - x).norm());
      sign_[key(x)] = nearest - 1;
    });
    for_nodes([&](const Vec3& x) {
      for (int a = 0; a < dimension; ++a) {
        const Vec3 y = x + Vec3::Unit(a);
        if (y[a] > size_ || (sign_[key(x)] < 0) == (sign_[key(y)] < 0)) continue;
        const double t = sign_[key(x)] / (sign_[key(x)] - sign_[key(y)]);
        surface_.push_back(x + t * Vec3::Unit(a));
      }
    });
  }
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    for (int i = -size_; i <= size_; ++i)
      for (int j = -size_; j <= size_; ++j)
        for (int k = -z_; k <= z_; ++k) visit(Vec3(i, j, k));
  }
  [[nodiscard]] double distance(const Vec3& x) {
    double nearest = SignedDistance::kBand;
    for (const Vec3& s : surface_) nearest = std::min(nearest, (s - x).norm());
    return sign_[key(x)] < 0 ? -nearest : nearest;
  }

 private:
  [[nodiscard]] static std::array<int, 3> key(const Vec3& x) {
    return {static_cast<int>(std::lround(x.x())), static_cast<int>(std::lround(x.y())),
            static_cast<int>(std::lround(x.z()))};
  }
  int size_;
  int z_;
  std::map<std::array<int, 3>, double> sign_;
  std::vector<Vec3> surface_;
};

/// Calls visit(x, distance) for the nodes of all blocks.
template <class Visit>
void for_distances(const PointBins& bins, const SignedDistance& distance, const Visit& visit) {
  const auto& lattice = bins.lattice();
  std::vector<float> nodes;
  for (std::size_t b = 0; b < bins.all_blocks().size(); ++b) {
    distance.copy_nodes(b, nodes);
    const int zs = lattice.dimension == 3 ? lattice.width + 1 : 1;
    for (int i = 0; i < lattice.width; ++i)
      for (int j = 0; j < lattice.width; ++j)
        for (int k = 0; k < lattice.depth; ++k)
          visit(lattice.world(bins.all_blocks()[b].block,
                              {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)}),
                static_cast<double>(nodes[static_cast<std::size_t>((i * (lattice.width + 1) + j) * zs + k)]));
  }
}

TEST(SignedDistance, EqualsItsBruteForceTwinInPlaneAndSpace) {
  for (const int dimension : {2, 3}) {
    Foam foam(dimension);
    std::mt19937 rng(3);
    std::uniform_real_distribution<double> x(-7, 7);
    // Clumps, holes and single points; none nearer than 4 to the twin's end at 12.
    for (int i = 0; i < (dimension == 3 ? 900 : 120); ++i)
      foam.add({x(rng), x(rng), dimension == 3 ? x(rng) : 0});
    const PointBins bins = foam.bins();
    const SignedDistance distance(bins, foam.resampler.nearest, 2);
    Twin twin(foam.positions(), dimension, 12);
    int inside = 0;
    for_distances(bins, distance, [&](const Vec3& node, double d) {
      if (node.cwiseAbs().maxCoeff() > 11) return;
      EXPECT_NEAR(d, twin.distance(node), 1e-5)
          << dimension << "D at " << node.transpose();  // float's rounding
      inside += d < 0 ? 1 : 0;
    });
    EXPECT_GT(inside, 50);
  }
}

// A ball of points at integers: its surface of unit spheres lies between R - 0.87 (from there inwards a point
// is nearer than half a cell's diagonal) and R + 1; the samples of it that the distance is taken to stand on
// the lattice's edges, which adds up to a quarter here. On average the two sides balance to 3/4.
TEST(SignedDistance, OfABallIsThatOfTheBall) {
  Foam foam(3);
  constexpr double kRadius = 9;
  foam.fill(Vec3::Constant(0.5), [](const Vec3& x) { return x.norm() < kRadius; });
  const PointBins bins = foam.bins();
  const SignedDistance distance(bins, foam.resampler.nearest, 1);
  double sum = 0;
  double count = 0;
  for_distances(bins, distance, [&](const Vec3& x, double d) {
    const double exact = std::clamp(x.norm() - kRadius, -4.0, 4.0);
    EXPECT_NEAR(d, exact, 1.25) << x.transpose();
    if (std::abs(exact) < 3) sum += d - exact, ++count;
  });
  EXPECT_NEAR(sum / count, 0, 0.75);
}

TEST(SignedDistance, SeesNoSurfaceAtAPeriodicSeam) {
  Foam foam(3, true);
  foam.fill(Vec3::Constant(0.5), [](const Vec3& x) { return std::abs(x.y()) < 7 && std::abs(x.z()) < 7; });
  const PointBins bins = foam.bins();
  const SignedDistance distance(bins, foam.resampler.nearest, 1);
  int deep = 0;
  for_distances(bins, distance, [&](const Vec3& x, double d) {
    if (std::abs(x.y()) > 1 || std::abs(x.z()) > 1) return;
    EXPECT_EQ(d, -4) << x.transpose();
    ++deep;
  });
  EXPECT_GE(deep, 48);
}

}  // namespace
}  // namespace lather
