// A new point is not torn from the start when nothing around it is.

#include "sim/mpm/resample/false_tears.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/unit/sim/mpm/resample/foam.h"

namespace lather {
namespace {

using namespace mpm::resample;  // the functions under test
using testing_support::Foam;

constexpr std::size_t kOobleck = 1;  // set of the material that tears at |dev C^p| = 1

/// A ball with a drilled hole whose points have turned about z, every other one by `angle`; no strain.
class TurnedFoam {
 public:
  explicit TurnedFoam(double angle) : foam(3) {
    foam.fill(
        Vec3::Constant(0.5),
        [](const Vec3& x) {
          const bool hole = std::abs(x.y() - 0.5) < 0.1 && std::abs(x.z() - 0.5) < 0.1 && std::abs(x.x()) < 6;
          return x.norm() < 9 && !hole;
        },
        kOobleck);
    bins = std::make_unique<PointBins>(foam.bins());
    ParticleSet<double>& set = foam.sets[kOobleck];
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix() - Mat3::Identity();
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        const Vec3 x = set.position(t, lane);
        const auto parity = static_cast<int>(std::floor(x.x()) + std::floor(x.y()) + std::floor(x.z())) & 1;
        for (int c = 0; c < 9; ++c)
          set.values<double>(t, Field::kDeformation, c)[lane] = parity * turn(c / 3, c % 3);
      }
    const SignedDistance distance(*bins, foam.resampler.nearest, 1);
    const auto darts =
        throw_darts(*bins, distance, foam.resampler.nearest, {1, 1}, foam.resampler.allowed, 1);
    points = compute_new_conserved_values(darts, *bins, foam.sets, 1);
    values = compute_new_field_values(points, *bins, foam.sets, foam.resampler.weights,
                                      NewVelocity::kConserving, 1);
  }

  /// Largest |dev C^p| of the points that are about to come.
  [[nodiscard]] double largest_plasticity() const {
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      largest = std::max(largest, plasticity(values.data() + i * values_stride(foam.sets)));
    return largest;
  }
  /// Largest |dev C^p| of the points that are there.
  [[nodiscard]] double largest_plasticity_in_set() const {
    const ParticleSet<double>& set = foam.sets[kOobleck];
    const PointValues list(set.layout());
    std::vector<double> point(list.count());
    double largest = 0;
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        if (set.values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
        list.read(set, {t, lane}, point.data());
        largest = std::max(largest, plasticity(point.data()));
      }
    return largest;
  }
  void mend(double threshold) {
    TearTest test = foam.resampler.tears;
    test.tear_threshold[kOobleck] = threshold;
    mend_false_tears(points, *bins, foam.sets, test, values);
  }

  Foam foam;
  std::unique_ptr<PointBins> bins;
  std::vector<NewPoint> points;
  std::vector<double> values;

 private:
  /// |dev C^p|, C^p = J^(-2/3) F^T be^-1 F. [Foam Algorithm 7]
  [[nodiscard]] double plasticity(const double* v) const {
    const PointValues list(foam.sets[kOobleck].layout());
    const double* s = v + list.at(Field::kElasticStrain);
    const double* g = v + list.at(Field::kDeformation);
    Mat3 be;
    be << 1 + s[0], s[3], s[4], s[3], 1 + s[1], s[5], s[4], s[5], 1 + s[2];
    Mat3 F;
    F << 1 + g[0], g[1], g[2], g[3], 1 + g[4], g[5], g[6], g[7], 1 + g[8];
    const double J = 1 + v[list.at(Field::kVolumeChange)];
    EXPECT_NEAR(F.determinant(), J, 1e-12);
    const Mat3 C = std::pow(J, -2.0 / 3) * F.transpose() * be.inverse() * F;
    return (C - C.trace() / 3 * Mat3::Identity()).norm();
  }
};

// F turned by 150 degrees and F = I both have C^p = I; their mean, made to have det F = 1, has |dev C^p|
// = 4.6 where the two weigh the same.
TEST(FalseTears, ThatMeansOfTurnedNeighboursShowAreMended) {
  TurnedFoam foam(150.0 / 180 * 3.14159265358979);
  ASSERT_GT(foam.points.size(), 5U);
  ASSERT_GT(foam.largest_plasticity(), 1.0);
  foam.mend(1.0);
  EXPECT_LT(foam.largest_plasticity(), 1.0);
}

TEST(FalseTears, AreMendedBeforeThePointsCome) {
  TurnedFoam foam(150.0 / 180 * 3.14159265358979);
  ASSERT_GT(foam.foam.avoid_void(1).inserted, 5U);
  EXPECT_LT(foam.largest_plasticity_in_set(), 1.0);
}

TEST(FalseTears, WhatIsNotWeakKeepsItsMean) {
  TurnedFoam foam(0.2);
  const std::vector<double> before = foam.values;
  ASSERT_GT(foam.points.size(), 5U);
  foam.mend(1.0);
  EXPECT_EQ(foam.values, before);
}

TEST(FalseTears, AWeakPointAmongWeakDonorsStaysWeak) {
  TurnedFoam foam(150.0 / 180 * 3.14159265358979);
  const std::vector<double> before = foam.values;
  foam.mend(-1);  // every point is weak
  EXPECT_EQ(foam.values, before);
}

}  // namespace
}  // namespace lather
