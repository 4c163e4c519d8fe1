// New points where gaps are, and nowhere else; nothing lost in sharing out, averaging and merging.
// [Foam Algorithms 3, 18 to 21]

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/mpm/resample/cover_masks.h"
#include "sim/mpm/resample/merge.h"
#include "tests/unit/sim/mpm/resample/foam.h"

namespace lather {
namespace {

using namespace mpm::resample;  // the functions under test
using testing_support::Foam;

constexpr double kBall = 10;

bool in_ball(const Vec3& x) {
  return x.norm() < kBall;
}

/// The largest distance from probes within `radius` of the middle to their nearest point.
double largest_gap(const Foam& foam, double radius, int dimension) {
  const std::vector<Vec3> points = foam.positions();
  std::mt19937 rng(9);
  std::uniform_real_distribution<double> x(-radius, radius);
  double largest = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 probe{x(rng), x(rng), dimension == 3 ? x(rng) : 0};  // braces: drawn in this order
    if (probe.norm() > radius) continue;
    double nearest = 1e30;
    for (const Vec3& p : points) nearest = std::min(nearest, (p - probe).squaredNorm());
    largest = std::max(largest, std::sqrt(nearest));
  }
  return largest;
}

class AvoidVoid : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, AvoidVoid, testing::Values(2, 3),
                         [](const auto& test) { return std::to_string(test.param) + "D"; });

TEST_P(AvoidVoid, AFullLatticeGetsNoPointWhereverItStands) {
  for (const double shift : {0.5, 0.0, 0.237}) {
    Foam foam(GetParam());
    foam.fill(Vec3::Constant(shift), in_ball);
    const Outcome done = foam.avoid_void(1);
    EXPECT_EQ(done.inserted, 0U) << shift;
    EXPECT_EQ(done.merged, 0U) << shift;
  }
}

// A row of points is taken out of a ball, so that gaps open along it; no node of the lattice lies further
// than r from a point, so all of it stays foam. One resampling leaves gaps of a finest tree cell's diagonal
// at most (a quarter of r, an eighth in 2D); what it misses others find.
TEST_P(AvoidVoid, ADrilledHoleIsFilledUntilEveryPlaceIsCovered) {
  Foam foam(GetParam());
  foam.fill(Vec3::Constant(0.5), [](const Vec3& x) {
    const bool row =
        std::abs(x.y() - 0.5) < 0.1 && std::abs(x.z()) < 0.6 && std::abs(x.x()) < 6 && x.z() > -0.1;
    return in_ball(x) && !row;
  });
  const double alpha = static_cast<double>(cover_radius(GetParam()));
  const double diagonal = std::sqrt(static_cast<double>(GetParam())) / (GetParam() == 3 ? 4 : 8);
  const double before = foam.shares();
  ASSERT_GT(largest_gap(foam, 6, GetParam()), alpha);
  EXPECT_GE(foam.avoid_void(1).inserted, 8U);
  EXPECT_LT(largest_gap(foam, 6, GetParam()), alpha + diagonal);
  for (std::uint64_t step = 2; step < 12; ++step) foam.avoid_void(step);
  EXPECT_LT(largest_gap(foam, 6, GetParam()), alpha + 0.1);
  EXPECT_EQ(foam.shares(), before);
}

TEST_P(AvoidVoid, NewPointsKeepOutOfAllSpheresAndAwayFromTheSurface) {
  Foam foam(GetParam());
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> x(-kBall, kBall);
  for (int i = 0; i < (GetParam() == 3 ? 9000 : 450); ++i) {
    const Vec3 p(x(rng), x(rng), GetParam() == 3 ? x(rng) : 0);
    if (in_ball(p)) foam.add(p);
  }
  const PointBins bins = foam.bins();
  const SignedDistance distance(bins, foam.resampler.nearest, 1);
  const auto samples = throw_darts(
      bins, distance, foam.resampler.nearest, {1, 1}, [](const Vec3&) { return true; }, 2);
  ASSERT_GT(samples.size(), 20U);
  std::vector<Vec3> points = foam.positions();
  const double alpha = static_cast<double>(cover_radius(GetParam()));
  for (const Sample& s : samples) {
    const Vec3 place = bins.lattice().world(bins.blocks()[s.block].block, s.at);
    for (const Vec3& p : points) EXPECT_GT((p - place).norm(), alpha - 1e-5);
    EXPECT_LT(place.norm(), kBall + 1 - 2.2 + 0.9);  // the surface, and how far apart its samples are
    points.push_back(place);
  }
}

// "b" tears and holds F, "a" before it does not: new and merged points take the values of their own list.
TEST_P(AvoidVoid, PointsOfAMaterialWithMoreFieldsTakeAllOfThem) {
  Foam foam = Foam::with_untearing_a(GetParam());
  ASSERT_FALSE(foam.sets[0].layout().has(Field::kDeformation));
  const auto ball_with_hole = [](const Vec3& x) {
    return in_ball(x) && !(std::abs(x.y() - 0.5) < 0.1 && std::abs(x.z()) < 0.6 && std::abs(x.x()) < 6);
  };
  const auto beside = [](const Vec3& x) { return std::abs(x.x()) > 20 && std::abs(x.y()) < 2; };
  foam.fill(Vec3::Constant(0.5), ball_with_hole, 1);
  foam.fill(Vec3::Constant(0.5), beside, 0);
  foam.add({8.51, 0.5, GetParam() == 3 ? 0.5 : 0}, 1);  // merges with the lattice's point
  const Vec3 v(3, -2, GetParam() == 3 ? 1 : 0);
  ParticleSet<double>& b = foam.sets[1];
  const auto for_b = [&](const auto& visit) {
    for (std::size_t t = 0; t < b.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane)
        if (b.values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint) visit(t, lane);
  };
  for_b([&](std::size_t t, int lane) {
    for (int a = 0; a < GetParam(); ++a) b.values<double>(t, Field::kVelocity, a)[lane] = v[a];
    b.values<double>(t, Field::kVolumeChange)[lane] = 0.25;
    b.values<double>(t, Field::kAffine, 1)[lane] = 0.75;
    b.values<double>(t, Field::kDeformation, 0)[lane] = 0.25;  // F = diag(1.25, 1, 1), det F = J
  });
  const Outcome done = foam.avoid_void(1);
  ASSERT_GT(done.inserted, 5U);
  ASSERT_EQ(done.merged, 1U);
  for_b([&](std::size_t t, int lane) {
    EXPECT_LT((b.velocity(t, lane) - v).norm(), 1e-12);
    EXPECT_NEAR(b.values<double>(t, Field::kVolumeChange)[lane], 0.25, 1e-12);
    EXPECT_NEAR(b.values<double>(t, Field::kAffine, 1)[lane], 0.75, 1e-12);
    EXPECT_NEAR(b.values<double>(t, Field::kDeformation, 0)[lane], 0.25, 1e-12);
  });
}

TEST(AvoidVoidIn3D, ObstaclesInsidesGetNoPoint) {
  Foam foam(3);
  foam.fill(Vec3::Constant(0.5), [](const Vec3& x) {
    return in_ball(x) && (std::abs(x.y() - 0.5) > 0.1 || std::abs(x.z() - 0.5) > 0.1);
  });
  foam.resampler.allowed = [](const Vec3& x) { return x.x() > 0; };
  const std::size_t before = foam.positions().size();
  EXPECT_GT(foam.avoid_void(1).inserted, 0U);
  EXPECT_GT(foam.positions().size(), before);
  Foam other(3);
  for (const Vec3& x : foam.positions())
    if (x.x() <= 0) other.add(x);
  Foam expected(3);
  expected.fill(Vec3::Constant(0.5), [](const Vec3& x) {
    return in_ball(x) && x.x() <= 0 && (std::abs(x.y() - 0.5) > 0.1 || std::abs(x.z() - 0.5) > 0.1);
  });
  EXPECT_EQ(other.positions().size(), expected.positions().size());
}

TEST_P(AvoidVoid, DonorsOfOneMaterialGiveMassAndMomentumThatTheNewPointsHave) {
  Foam foam(GetParam());
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> x(-kBall, kBall);
  for (int i = 0; i < (GetParam() == 3 ? 9000 : 600); ++i) {
    const Vec3 p(x(rng), x(rng), GetParam() == 3 ? x(rng) : 0);
    if (in_ball(p)) foam.add(p, p.x() > 0 ? 1 : 0, p.x() > 0 ? Vec3(3, 0, 0) : Vec3(p.y(), -p.x(), 0));
  }
  const double shares[2] = {foam.shares(0), foam.shares(1)};
  const Vec3 momentum = foam.momentum();
  const std::uint32_t first_new = foam.next_id;
  const Outcome done = foam.avoid_void(7);
  EXPECT_GT(done.inserted, 20U);
  EXPECT_EQ(foam.next_id, first_new + done.inserted);
  for (const std::size_t s : {0U, 1U}) EXPECT_EQ(foam.shares(s), shares[s]) << s;
  // Rounding of some hundred sums of about a thousand.
  EXPECT_LT((foam.momentum() - momentum).norm(), 1e-10);
  // Material b, moved as one, gave its new points its own velocity.
  const auto& b = foam.sets[1];
  for (std::size_t t = 0; t < b.tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane) {
      if (b.values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
      EXPECT_GT(b.share(t, lane), 0);
      EXPECT_NEAR(b.velocity(t, lane).x(), 3, 1e-12);
    }
}

/// Sets a field's component at all points to value(x).
template <class Value>
void set_field(ParticleSet<double>& set, Field field, int component, const Value& value) {
  for (std::size_t t = 0; t < set.tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane)
      set.values<double>(t, field, component)[lane] = value(set.position(t, lane));
}

TEST(NewFieldValues, OfAUniformStateAreThatStateAndBeStaysUnimodular) {
  Foam foam(3);
  foam.fill(Vec3::Constant(0.5), [](const Vec3& x) {
    return in_ball(x) && (std::abs(x.y() - 0.5) > 0.1 || std::abs(x.z() - 0.5) > 0.1);
  });
  auto& set = foam.sets[0];
  // be = diag(1.2, 1/1.2, 1) with a shear xy of 0: its determinant is 1.
  set_field(set, Field::kVolumeChange, 0, [](const Vec3&) { return 0.03; });
  set_field(set, Field::kElasticStrain, 0, [](const Vec3&) { return 0.2; });
  set_field(set, Field::kElasticStrain, 1, [](const Vec3&) { return 1 / 1.2 - 1; });
  const std::uint32_t first_new = foam.next_id;
  ASSERT_GT(foam.avoid_void(3).inserted, 5U);
  for (std::size_t t = 0; t < set.tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane) {
      const std::uint32_t id = set.values<std::uint32_t>(t, Field::kId)[lane];
      if (id == kNoPoint || id < first_new) continue;
      EXPECT_NEAR(set.values<double>(t, Field::kVolumeChange)[lane], 0.03, 1e-13);
      EXPECT_NEAR(set.values<double>(t, Field::kElasticStrain, 0)[lane], 0.2, 1e-12);
      EXPECT_NEAR(set.values<double>(t, Field::kElasticStrain, 1)[lane], 1 / 1.2 - 1, 1e-12);
      EXPECT_NEAR(set.values<double>(t, Field::kElasticStrain, 2)[lane], 0, 1e-12);
    }
}

TEST(NewFieldValues, InterpolatedVelocityFollowsALinearFieldInsideALattice) {
  Foam foam(3);
  foam.resampler.velocity = NewVelocity::kInterpolated;
  foam.fill(Vec3::Constant(0.5), in_ball);
  auto& set = foam.sets[0];
  set_field(set, Field::kVelocity, 0, [](const Vec3& x) { return 2 + 0.5 * x.y(); });
  const PointBins bins = foam.bins();
  NewPoint point;
  // Block (3, 3, 3) of 8 m begins at -24 - 1 + 24 = -1.
  for (std::size_t b = 0; b < bins.blocks().size(); ++b)
    if (bins.blocks()[b].block == BlockCoord{3, 3, 3}) point.sample = {b, {1.3F, 1.6F, 0.9F}};
  point.share = 1;
  const PointValues values(set.layout());
  const auto got = compute_new_field_values<double>({point}, bins, foam.sets, foam.resampler.weights,
                                                    NewVelocity::kInterpolated, 1);
  // Means on nodes of a symmetric lattice, and interpolation, keep linear fields.
  EXPECT_NEAR(got[values.at(Field::kVelocity)], 2 + 0.5 * 0.6, 1e-6);
}

TEST(PointValues, RenormalizeGivesUnitDeterminant) {
  Foam foam(3);
  const PointValues values(foam.sets[0].layout());
  std::vector<double> v(values.count(), 0.0);
  double* B = v.data() + values.at(Field::kElasticStrain);
  const double given[6] = {0.3, -0.1, 0.2, 0.1, -0.2, 0.05};
  std::copy(given, given + 6, B);
  values.renormalize(v.data());
  Mat3 be;
  be << 1 + B[0], B[3], B[4], B[3], 1 + B[1], B[5], B[4], B[5], 1 + B[2];
  EXPECT_NEAR(be.determinant(), 1, 1e-14);
  Mat3 before;
  before << 1.3, 0.1, -0.2, 0.1, 0.9, 0.05, -0.2, 0.05, 1.2;
  EXPECT_LT((be - before / std::cbrt(before.determinant())).norm(), 1e-14);
}

TEST(PointValues, RenormalizeMakesTheDeformationAgreeWithTheVolumeRatio) {
  for (const int dimension : {2, 3}) {
    Foam foam(dimension);
    const PointValues values(foam.sets[0].layout());
    std::vector<double> v(values.count(), 0.0);
    double* G = v.data() + values.at(Field::kDeformation);
    for (std::size_t c = 0; c < values.components(Field::kDeformation); ++c)
      G[c] = 0.05 * static_cast<double>(c) - 0.1;
    v[values.at(Field::kVolumeChange)] = 0.2;
    const auto F = [&] {
      Mat3 m = Mat3::Identity();
      if (dimension == 3) {
        for (int i = 0; i < 9; ++i) m(i / 3, i % 3) += G[i];
      } else {
        for (int i = 0; i < 4; ++i) m(i / 2, i % 2) += G[i];
        m(2, 2) += G[4];
      }
      return m;
    };
    const Mat3 before = F();
    values.renormalize(v.data());
    EXPECT_NEAR(F().determinant(), 1.2, 1e-14);
    EXPECT_LT((F() - before * std::cbrt(1.2 / before.determinant())).norm(), 1e-14);
  }
}

TEST(Merge, JoinsOnlyPointsOfOneMaterialThatAreTooCloseAndKeepsWhatIsConserved) {
  Foam foam(3);
  foam.add({0.5, 0.5, 0.5}, 0, {1, 0, 0});
  foam.add({0.525, 0.5, 0.5}, 0, {0, 4, 0});  // 0.025 away: merged
  foam.add({3.5, 0.5, 0.5}, 0);
  foam.add({3.535, 0.5, 0.5}, 0);  // 0.035 away: not
  foam.add({-5, 0.5, 0.5}, 0);
  foam.add({-5, 0.51, 0.5}, 1);  // of another material
  foam.add({6.999, 0.5, 0.5}, 0, {1, 1, 1});
  foam.add({7.009, 0.5, 0.5}, 0, {1, 1, 1});  // across the border of two blocks
  const Vec3 momentum = foam.momentum();
  const Outcome done = foam.avoid_void(1);
  EXPECT_EQ(done.inserted, 0U);
  EXPECT_EQ(done.merged, 2U);
  EXPECT_EQ(foam.shares(0), 7);
  EXPECT_EQ(foam.shares(1), 1);
  EXPECT_LT((foam.momentum() - momentum).norm(), 1e-14);
  bool found = false;
  for (const Vec3& x : foam.positions())
    found = found || (x - Vec3(0.5125, 0.5, 0.5)).norm() < 1e-6;  // the centre, to float's rounding
  EXPECT_TRUE(found);
  EXPECT_EQ(foam.positions().size(), 5U);
}

TEST(Merge, PairsAreDisjoint) {
  Foam foam(2);
  for (int i = 0; i < 5; ++i) foam.add({0.5 + 0.01 * i, 0.5, 0});
  const auto pairs = find_pairs(foam.bins(), 1);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(foam.avoid_void(1).merged, 2U);
  EXPECT_EQ(foam.shares(), 5);
}

}  // namespace
}  // namespace lather
