#include <gtest/gtest.h>

#include <cmath>

#include "render/point_normals.h"
#include "tests/unit/render/sample_frames.h"

namespace lather::render {
namespace {

/// A ball of points on a lattice around `center`.
std::vector<std::array<float, 3>> ball(const Vec3& center, double radius, double distance) {
  std::vector<std::array<float, 3>> points;
  const int n = static_cast<int>(radius / distance);
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k) {
        const Eigen::Vector3f p = (distance * Vec3(i, j, k)).cast<float>();
        if (p.norm() > static_cast<float>(radius)) continue;
        const Eigen::Vector3f world = p + center.cast<float>();
        points.push_back({world.x(), world.y(), world.z()});
      }
  return points;
}

TEST(PointNormals, AtTheSurfaceOfABallTheyPointAwayFromItsCentre) {
  const Vec3 center(1, 2, 3);
  const auto points = ball(center, 0.2, 0.01);
  const auto normals = point_normals(points, 0.005);
  int at_surface = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 out = Vec3(points[i][0], points[i][1], points[i][2]) - center;
    if (out.norm() < 0.19) continue;
    ++at_surface;
    const Vec3 normal = Vec3(normals[i][0], normals[i][1], normals[i][2]).normalized();
    ASSERT_GT(normal.dot(out.normalized()), 0.9);
    ASSERT_GT(normals[i][3], 100);
  }
  EXPECT_GT(at_surface, 1000);
}

TEST(PointNormals, DeepInsideAndAloneTheyCountForNothing) {
  const auto points = ball(Vec3::Zero(), 0.2, 0.01);
  const auto normals = point_normals(points, 0.005);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::hypot(points[i][0], points[i][1], points[i][2]) < 0.1F) {
      ASSERT_LT(normals[i][3], 20);
    }
  EXPECT_EQ(point_normals({{0.3F, 0.2F, 0.1F}}, 0.005).front()[3], 0);
}

TEST(PointNormals, FarApartPointsNeedNoHugeGrid) {
  EXPECT_EQ(point_normals({{-1000, -1000, -1000}, {1000, 1000, 1000}}, 1e-4).size(), 2U);
}

}  // namespace
}  // namespace lather::render
