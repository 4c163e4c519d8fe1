// Points in tiles sorted by block: nothing lost, nothing doubled, wrapped where periodic, dropped where open.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "sim/particles/particle_set.h"

namespace lather {
namespace {

const std::vector<Field> kFields = {Field::kFraction,      Field::kVelocity, Field::kVolumeChange,
                                    Field::kElasticStrain, Field::kId,       Field::kCell};

ParticleSet<float> random_points(int count, double extent) {
  ParticleSet<float> set(3, kFields, Vec3::Zero(), 0.1);
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> x(0, extent);
  for (int i = 0; i < count; ++i)
    set.add({x(rng), x(rng), x(rng)}, {i * 1.0, 0, 0}, Mat3::Zero(), static_cast<std::uint32_t>(i));
  return set;
}

/// id -> position and x-velocity, of all points.
std::map<std::uint32_t, std::pair<Vec3, double>> contents(const ParticleSet<float>& set) {
  std::map<std::uint32_t, std::pair<Vec3, double>> all;
  for (std::size_t t = 0; t < set.tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane) {
      const std::uint32_t id = set.values<std::uint32_t>(t, Field::kId)[lane];
      if (id != kNoPoint) all[id] = {set.position(t, lane), set.velocity(t, lane).x()};
    }
  return all;
}

CellBounds ten_cells() {
  return {3, {12, 12, 12}, {false, false, false}, false};
}

TEST(Sort, KeepsEveryPointWithAllItsFields) {
  ParticleSet<float> set = random_points(5000, 1.2);
  const auto before = contents(set);
  ASSERT_EQ(before.size(), 5000U);
  EXPECT_EQ(set.sort(ten_cells(), 2).points, 0U);
  EXPECT_EQ(set.size(), 5000U);
  EXPECT_EQ(contents(set), before);
}

TEST(Sort, PutsEveryPointIntoItsBlocksTiles) {
  ParticleSet<float> set = random_points(5000, 1.2);
  set.sort(ten_cells(), 3);
  std::int64_t sum = 0;
  for (std::size_t r = 0; r < set.ranges().size(); ++r) {
    const BlockRange& range = set.ranges()[r];
    if (r > 0) {
      EXPECT_LT(block_key(set.ranges()[r - 1].block), block_key(range.block));
    }
    sum += range.count;
    for (int i = 0; i < range.count; ++i) {
      const Vec3 x = set.position(range.tile_of(i), i % kTile) / 0.1;
      for (int a = 0; a < 3; ++a) {
        const double home = 4.0 * range.block[static_cast<std::size_t>(a)];
        EXPECT_GE(x[a], home - kHomeShift - 1e-6);
        EXPECT_LE(x[a], home + 4 - kHomeShift + 1e-6);
      }
    }
  }
  EXPECT_EQ(sum, 5000);
}

TEST(Sort, OrderDoesNotDependOnThreads) {
  ParticleSet<float> a = random_points(20000, 1.2);
  ParticleSet<float> b = random_points(20000, 1.2);
  a.sort(ten_cells(), 1);
  b.sort(ten_cells(), 7);
  std::string bytes_a;
  std::string bytes_b;
  a.save(bytes_a);
  b.save(bytes_b);
  EXPECT_EQ(bytes_a, bytes_b);
}

TEST(Sort, WrapsPeriodicAxesAndDropsPointsOutsideAnOpenDomain) {
  ParticleSet<float> set(3, kFields, Vec3::Zero(), 0.1);
  set.add({1.35, 0.5, 0.5}, Vec3::Zero(), Mat3::Zero(), 0);   // 0.15 beyond the periodic end
  set.add({-0.35, 0.5, 0.5}, Vec3::Zero(), Mat3::Zero(), 1);  // 0.35 before its start
  set.add({0.5, 1.25, 0.5}, Vec3::Zero(), Mat3::Zero(), 2);   // outside the open axis
  set.add({0.5, 0.5, -0.01}, Vec3::Zero(), Mat3::Zero(), 3);
  const CellBounds bounds = {3, {12, 12, 12}, {true, false, false}, true};
  const Departures gone = set.sort(bounds, 1);
  EXPECT_EQ(gone.points, 2U);
  EXPECT_EQ(gone.shares, 2);
  const auto left = contents(set);
  ASSERT_EQ(left.size(), 2U);
  EXPECT_NEAR(left.at(0).first.x(), 0.15, 1e-7);
  EXPECT_NEAR(left.at(1).first.x(), 0.85, 1e-7);
}

TEST(Sort, PositionsSurviveTheWayIntoTheTileToAQuantum) {
  ParticleSet<float> set(2, kFields, Vec3(-0.3, 0.2, 0), 0.1);
  const Vec3 x(0.123456789, 0.987654321, 0);
  set.add(x, Vec3::Zero(), Mat3::Zero(), 0);
  EXPECT_LT((set.position(0, 0) - x).norm(), 0.1 * 0x1p-29);
}

}  // namespace
}  // namespace lather
