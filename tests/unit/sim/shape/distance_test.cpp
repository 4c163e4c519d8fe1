#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/shape/placement.h"
#include "tests/unit/sim/shape/samples.h"

namespace lather::test {
namespace {

TEST(Distance, ChangesNoFasterThanThePointMoves) {
  std::mt19937_64 random(1);
  for (const Sample& s : samples()) {
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 a = random_point(random, kWorld);
      const double reach = std::pow(10.0, -(i % 8));  // pairs from far apart to close together
      const Vec3 b = a + reach * random_point(random, {Vec3::Constant(-0.5), Vec3::Constant(0.5)});
      const double change = std::abs(distance(*s.shape, a) - distance(*s.shape, b));
      ASSERT_LE(change, (a - b).norm() * (1 + 1e-9) + 1e-13) << s.name << " at " << a.transpose();
    }
  }
}

/// A closed mesh's points lie on the surface, so none may be nearer than the distance says. For exact
/// distances the nearest one is no further than a triangle's width beyond it.
TEST(Distance, AgreesWithTheNearestPointOfAFineSurface) {
  constexpr double kDetail = 0.02;
  std::mt19937_64 random(2);
  for (const Sample& s : samples()) {
    if (!s.has_closed_mesh) continue;
    const TriangleMesh mesh = tessellate(*s.shape, kWorld, kDetail);
    std::vector<Vec3> surface;
    for (const auto& t : mesh.triangles) {
      const auto corner = [&](std::size_t i) {
        const auto& p = mesh.positions[t[i]];
        return Vec3(p[0], p[1], p[2]);
      };
      // Long flat triangles are sampled inside as well.
      const Vec3 a = corner(0), b = corner(1), c = corner(2);
      const double widest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const int n = std::max(1, static_cast<int>(std::ceil(widest / (2 * kDetail))));
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) surface.push_back(a + (b - a) * i / n + (c - a) * j / n);
      }
    }
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = random_point(random, kWorld);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& p : surface) nearest = std::min(nearest, (p - x).squaredNorm());
      nearest = std::sqrt(nearest);
      const double d = std::abs(distance(*s.shape, x));
      ASSERT_LE(d, nearest + 2e-3) << s.name << " at " << x.transpose();
      const double least = s.exact ? nearest - 0.04 : 0;
      ASSERT_GE(d, least) << s.name << " at " << x.transpose();
    }
  }
}

TEST(Distance, VanishesAfterOneStepAlongTheNormalWhereItIsExact) {
  std::mt19937_64 random(3);
  for (const Sample& s : samples()) {
    if (!s.exact) continue;
    for (int i = 0; i < 2'000; ++i) {
      const Vec3 x = random_point(random, kWorld);
      const double d = distance(*s.shape, x);
      if (d < 0) continue;  // inside, the medial axis has no normal
      const Vec3 foot = x - d * normal(*s.shape, x, 1e-6);
      ASSERT_NEAR(distance(*s.shape, foot), 0, 2e-5) << s.name << " at " << x.transpose();
    }
  }
}

TEST(Distance, IsNegativeOverTheShapesVolume) {
  for (const Sample& s : samples()) {
    if (s.volume == 0) continue;
    const Box3 box = bounds(*s.shape, kWorld);
    constexpr int kSteps = 120;
    int inside = 0;
    const Vec3 cell = box.extent() / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        for (int k = 0; k < kSteps; ++k) {
          const Vec3 x = box.min + cell.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
          if (distance(*s.shape, x) < 0) ++inside;
        }
      }
    }
    EXPECT_NEAR(inside * cell.prod(), s.volume, 4e-3 * s.volume) << s.name;
  }
}

TEST(Distance, OfAnEllipsoidIsTheDistanceFromItsNearestPoint) {
  std::mt19937_64 random(4);
  for (const Vec3& radii : {Vec3(0.9, 0.3, 0.6), Vec3(1, 1, 0.2), Vec3(0.5, 0.5, 0.5), Vec3(0.01, 1, 0.02)}) {
    const Shape shape{EllipsoidShape{radii}};
    std::uniform_real_distribution<double> angle(0, M_PI);
    for (int i = 0; i < 5'000; ++i) {
      const double u = angle(random), v = 2 * angle(random);
      Vec3 on_unit(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u));
      if (i % 3 == 0) on_unit[i % 9 / 3] = 0;
      on_unit.normalize();
      const Vec3 foot = on_unit.cwiseProduct(radii);
      const Vec3 n = on_unit.cwiseQuotient(radii).normalized();
      // Outside every normal leads back to its foot; inside that holds up to the smallest radius of
      // curvature.
      const double inner = radii.minCoeff() * radii.minCoeff() / radii.maxCoeff();
      for (const double d : {2.0, 0.1, 1e-5, 0.0, -0.01 * inner, -0.9 * inner}) {
        ASSERT_NEAR(distance(shape, foot + d * n), d, 1e-10)
            << radii.transpose() << " at " << foot.transpose();
      }
    }
    EXPECT_NEAR(distance(shape, Vec3::Zero()), -radii.minCoeff(), 1e-14);
  }
}

TEST(Distance, OfASmoothUnionDiffersFromThePlainOneByAQuarterOfTheSmoothingAtMost) {
  const ShapePtr a = make(SphereShape{0.5}), b = place(a, {0.7, 0, 0});
  const Shape plain{UnionShape{{a, b}, 0}}, smooth{UnionShape{{a, b}, 0.2}};
  std::mt19937_64 random(5);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 x = random_point(random, kWorld);
    const double filled = distance(plain, x) - distance(smooth, x);
    ASSERT_GE(filled, 0);
    ASSERT_LE(filled, 0.05 + 1e-15);
  }
  EXPECT_NEAR(distance(plain, {0.35, 3, 0}) - distance(smooth, {0.35, 3, 0}), 0.05, 1e-12);
}

TEST(Union, LeavesOutNothingThatCounts) {
  // Four ellipsoids: the union spares itself the distances of those that are far. Here is the union of all of
  // them, written out.
  const double width = 0.3;
  std::vector<ShapePtr> parts;
  for (int i = 0; i < 4; ++i)
    parts.push_back(std::make_shared<Shape>(
        Shape{PlacedShape(std::make_shared<Shape>(Shape{EllipsoidShape{{0.3 + 0.1 * i, 0.5, 0.8 - 0.1 * i}}}),
                          {0.6 * i - 1, 0.2 * i, 0.1 * i}, {20.0 * i, 0, 10}, 1 + 0.2 * i)}));
  const Shape together{UnionShape{parts, width}};
  for (int n = 0; n < 20 * 20 * 20; ++n) {
    const int plane = n / 400;
    const int row = n / 20 % 20;
    const Vec3 x = Vec3(n % 20, row, plane) * 0.3 - Vec3(3, 3, 3);
    double expected = distance(*parts[0], x);
    for (int i = 1; i < 4; ++i) {
      const double other = distance(*parts[i], x);
      const double overlap = std::max(width - std::abs(expected - other), 0.0);
      expected = std::min(expected, other) - 0.25 * overlap * overlap / width;
    }
    ASSERT_EQ(distance(together, x), expected) << x.transpose();
  }
}

TEST(Normal, IsUnitAndPointsOutOfTheShape) {
  const Shape box{BoxShape{{2, 4, 6}, 0}};
  EXPECT_TRUE(normal(box, {1, 0.3, 0.2}, 1e-6).isApprox(Vec3::UnitX(), 1e-9));
  EXPECT_TRUE(normal(box, {0.1, -2.5, 0.2}, 1e-6).isApprox(-Vec3::UnitY(), 1e-9));
  EXPECT_TRUE(normal(Shape{SphereShape{1}}, Vec3::Zero(), 1e-6).isApprox(Vec3::UnitY()))
      << "no gradient at the centre";
}

TEST(Placement, TurnsAboutXThenYThenZAboutFixedAxes) {
  const Vec3 x(0.3, -1.2, 0.7);
  const Vec3 expected =
      Eigen::AngleAxisd(radians(70), Vec3::UnitZ()) *
      (Eigen::AngleAxisd(radians(-40), Vec3::UnitY()) * (Eigen::AngleAxisd(radians(25), Vec3::UnitX()) * x));
  EXPECT_TRUE((rotation_of({25, -40, 70}) * x).isApprox(expected, 1e-14));
}

TEST(Bounds, HoldTheShapeAndTouchItWhereItIsNotTurned) {
  std::mt19937_64 random(6);
  for (const Sample& s : samples()) {
    const Box3 box = bounds(*s.shape, kWorld);
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 x = random_point(random, kWorld);
      if (distance(*s.shape, x) >= 0) continue;
      ASSERT_TRUE((x.array() >= box.min.array() - 1e-12).all() &&
                  (x.array() <= box.max.array() + 1e-12).all())
          << s.name << " at " << x.transpose();
    }
  }
  EXPECT_TRUE(bounds(*make(TorusShape{0.8, 0.25}), kWorld).max.isApprox(Vec3(1.05, 0.25, 1.05)));
}

TEST(Bounds, OfAPlaneAreClippedToTheWorld) {
  const Box3 level = bounds(*place(make(PlaneShape{}), {0, 0.5, 0}), kWorld);
  EXPECT_TRUE(level.min.isApprox(kWorld.min));
  EXPECT_TRUE(level.max.isApprox(Vec3(2, 0.5, 2)));
  const Box3 steep = bounds(Shape{PlaneShape{{1, 1, 0}}}, {Vec3(1, -4, 0), Vec3(5, 3, 1)});
  EXPECT_TRUE(steep.max.isApprox(Vec3(4, -1, 1)));
}

}  // namespace
}  // namespace lather::test
