#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "tests/unit/sim/shape/samples.h"

namespace lather::test {
namespace {

constexpr double kDetail = 0.05;

Vec3 wide(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles) {
    six += wide(mesh.positions[t[0]]).dot(wide(mesh.positions[t[1]]).cross(wide(mesh.positions[t[2]])));
  }
  return six / 6;
}

TEST(Mesh, OfEveryBoundedShapeIsClosed) {
  for (const Sample& s : samples()) {
    if (!s.has_closed_mesh) continue;
    const TriangleMesh mesh = tessellate(*s.shape, kWorld, kDetail);
    // Sharp edges hold their points twice, bit for bit: join them by position.
    std::map<std::array<float, 3>, int> index;
    std::map<std::pair<int, int>, int>
        balance;  // times walked from the first to the second, less the way back
    std::map<std::pair<int, int>, int> count;
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto id = [&](std::size_t corner) {
          return index.emplace(mesh.positions[t[corner % 3]], static_cast<int>(index.size())).first->second;
        };
        const int a = id(i), b = id(i + 1);
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
        ++count[std::minmax(a, b)];
      }
    }
    ASSERT_FALSE(balance.empty()) << s.name;
    for (const auto& [edge, sum] : balance) {
      ASSERT_EQ(sum, 0) << s.name;
      ASSERT_EQ(count[edge] % 2, 0) << s.name;
    }
  }
}

TEST(Mesh, LiesOnTheSurface) {
  for (const Sample& s : samples()) {
    const TriangleMesh mesh = tessellate(*s.shape, kWorld, kDetail);
    ASSERT_EQ(mesh.positions.size(), mesh.normals.size()) << s.name;
    for (const auto& p : mesh.positions) ASSERT_NEAR(distance(*s.shape, wide(p)), 0, 2e-6) << s.name;
  }
}

TEST(Mesh, HoldsTheShapesVolume) {
  for (const Sample& s : samples()) {
    if (s.volume == 0 || !s.has_closed_mesh) continue;
    const double held = volume(tessellate(*s.shape, kWorld, kDetail));
    EXPECT_NEAR(held, s.volume, 0.03 * s.volume) << s.name;
  }
}

TEST(Mesh, NormalsAreUnitAndAgreeWithTheTrianglesAroundThem) {
  for (const Sample& s : samples()) {
    const TriangleMesh mesh = tessellate(*s.shape, kWorld, kDetail);
    double agreeing = 0, area = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3 a = wide(mesh.positions[t[0]]), b = wide(mesh.positions[t[1]]),
                 c = wide(mesh.positions[t[2]]);
      const Vec3 face = 0.5 * (b - a).cross(c - a);
      for (const std::uint32_t corner : t) {
        const Vec3 n = wide(mesh.normals[corner]);
        ASSERT_NEAR(n.norm(), 1, 1e-5) << s.name;
        area += face.norm();
        if (n.dot(face) > 0.7 * face.norm()) agreeing += face.norm();
      }
    }
    EXPECT_GT(agreeing, 0.95 * area) << s.name;  // a meshed combination rounds its sharp rims
  }
}

TEST(Mesh, OfAPlaneIsItsPartInsideTheWorld) {
  const Box3 world{Vec3(-1, 0, -2), Vec3(1, 3, 2)};
  const TriangleMesh mesh = tessellate(*place(make(PlaneShape{}), {5, 0.5, 5}), world, kDetail);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = wide(mesh.positions[t[0]]), b = wide(mesh.positions[t[1]]), c = wide(mesh.positions[t[2]]);
    const Vec3 face = 0.5 * (b - a).cross(c - a);
    EXPECT_GT(face.y(), 0) << "seen from above it is counter-clockwise";
    area += face.norm();
  }
  EXPECT_NEAR(area, 2 * 4, 1e-5);
  for (const auto& p : mesh.positions) EXPECT_FLOAT_EQ(p[1], 0.5F);
}

TEST(Mesh, OfAPlaneInAFlatWorldHasSomeDepth) {
  const Box3 flat{Vec3(-1, 0, 0), Vec3(1, 1, 0)};
  const TriangleMesh mesh = tessellate(*place(make(PlaneShape{}), {0, 0.2, 0}), flat, kDetail);
  EXPECT_GE(mesh.triangles.size(), 2U);
}

TEST(Mesh, OfACombinationWithAPlaneIsClippedToTheWorld) {
  const Shape hill{UnionShape{{make(PlaneShape{}), make(SphereShape{0.5})}, 0}};
  const TriangleMesh mesh = tessellate(hill, {Vec3::Constant(-1), Vec3::Constant(1)}, kDetail);
  EXPECT_NEAR(volume(mesh), 4 + 2.0 / 3 * M_PI * 0.125, 0.05);
  for (const auto& p : mesh.positions) EXPECT_LE(wide(p).cwiseAbs().maxCoeff(), 1 + 1e-5);
}

// Cells as fine as the detail would be two thousand million, most of them in the margin around it.
TEST(Mesh, OfALongThinUnionIsNoFinerThanItsLengthAllows) {
  UnionShape pair;
  pair.of = {make(SphereShape{0.01}), place(make(SphereShape{0.01}), {1e6, 0, 0})};
  const TriangleMesh mesh = tessellate(*make(pair), kWorld, 5e-3);
  EXPECT_LT(mesh.triangles.size(), 100'000U);
}

TEST(Mesh, OfAHugeCombinationStaysSmall) {
  const Shape shape{UnionShape{{make(SphereShape{1}), place(make(SphereShape{1}), {1, 0, 0})}, 0}};
  const TriangleMesh mesh = tessellate(shape, kWorld, 1e-6);
  EXPECT_LT(mesh.triangles.size(), 2'000'000U);
  EXPECT_GT(mesh.triangles.size(), 10'000U);
}

}  // namespace
}  // namespace lather::test
