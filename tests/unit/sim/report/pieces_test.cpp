// Connected pieces of the material, and the time of a tear.

#include "sim/report/pieces.h"

#include <gtest/gtest.h>

namespace lather {
namespace {

constexpr double kCell = 0.1;

/// Points at the middles of these cells.
ParticleSet<float> points_in(const std::vector<Vec3>& cells, int dimension = 3) {
  ParticleSet<float> set(dimension, {Field::kFraction, Field::kVelocity, Field::kId, Field::kCell},
                         Vec3::Zero(), kCell);
  std::uint32_t id = 0;
  for (const Vec3& c : cells) {
    Vec3 x = (c + Vec3::Constant(0.5)) * kCell;
    if (dimension == 2) x.z() = 0;
    set.add(x, Vec3::Zero(), Mat3::Zero(), id++);
  }
  return set;
}

Pieces pieces_of(const std::vector<Vec3>& cells, const CellBounds& bounds = {3, {20, 20, 20}, {}, false},
                 int width = 1) {
  std::vector<ParticleSet<float>> sets;
  sets.push_back(points_in(cells, bounds.dimension));
  sets[0].sort(bounds, 1);
  return find_pieces(sets, bounds, width);
}

TEST(Pieces, CellsThatShareACornerAreOnePiece) {
  EXPECT_EQ(pieces_of({{4, 4, 4}, {5, 3, 5}}).count, 1U);
  EXPECT_EQ(pieces_of({{4, 4, 4}, {5, 5, 5}}).count, 1U);
  EXPECT_EQ(pieces_of({{3, 7, 4}, {4, 6, 3}, {5, 5, 4}}).count, 1U);
}

TEST(Pieces, AnEmptyCellBetweenMakesTwo) {
  const Pieces p = pieces_of({{4, 4, 4}, {4, 4, 4}, {4, 5, 4}, {4, 7, 4}});
  EXPECT_EQ(p.count, 2U);
  EXPECT_EQ(p.largest_share, 0.75);
  EXPECT_EQ(p.second_share, 0.25);
}

TEST(Pieces, PeriodicFacesConnect) {
  const std::vector<Vec3> cells = {{0, 3, 3}, {19, 3, 3}};
  EXPECT_EQ(pieces_of(cells).count, 2U);
  EXPECT_EQ(pieces_of(cells, {3, {20, 20, 20}, {true, false, false}, false}).count, 1U);
}

TEST(Pieces, WiderCellsBridgeSmallerGaps) {
  const std::vector<Vec3> cells = {{-2, 4, 4}, {1, 4, 4}, {4, 4, 4}, {9, 4, 4}};  // in pairs: -1 | 0 | 2 | 4
  EXPECT_EQ(pieces_of(cells).count, 4U);
  EXPECT_EQ(pieces_of(cells, {3, {20, 20, 20}, {}, false}, 2).count, 3U);
}

TEST(Pieces, CrumbsAreNotCounted) {
  std::vector<Vec3> cells(300, Vec3(4, 4, 4));
  cells.emplace_back(10, 10, 10);
  cells.emplace_back(10, 10, 10);  // 2 of 302 points
  const Pieces p = pieces_of(cells);
  EXPECT_EQ(p.count, 1U);
  EXPECT_EQ(p.second_share, 2.0 / 302);
}

TEST(Pieces, AWindingThreadIsOnePieceInThePlane) {
  std::vector<Vec3> cells;
  for (int row = 0; row < 9; row += 2) {
    for (int i = 0; i < 9; ++i) cells.emplace_back(i, row, 0);
    cells.emplace_back(row % 4 == 0 ? 8 : 0, row + 1, 0);
  }
  const CellBounds plane{2, {20, 20, 1}, {}, false};
  EXPECT_EQ(pieces_of(cells, plane).count, 1U);
  cells.erase(cells.begin() + 9);  // the first bend
  EXPECT_EQ(pieces_of(cells, plane).count, 2U);
}

TEST(Pieces, NoPointsAreNoPiece) {
  const Pieces p = pieces_of({});
  EXPECT_EQ(p.count, 0U);
  EXPECT_EQ(p.largest_share, 0);
}

TEST(TearTime, IsTheFirstFrameOfALastingSeparation) {
  std::vector<FrameMeasure> frames(20);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].time = 0.1 * static_cast<double>(i);
    frames[i].second_piece_share = i == 3 || i >= 8 ? 0.3 : 0.001;
  }
  const auto torn = tear_time(frames, 0.1, 0.35);
  ASSERT_TRUE(torn.has_value());
  EXPECT_DOUBLE_EQ(*torn, 0.8);
  EXPECT_FALSE(tear_time(frames, 0.4, 0.35).has_value());
  EXPECT_FALSE(tear_time(frames, 0.1, 2).has_value());
}

}  // namespace
}  // namespace lather
