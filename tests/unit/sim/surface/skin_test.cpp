// The skin of points: closed, smooth, of the right volume, and the same for any number of threads.

#include "sim/surface/skin.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/shape/mesh_file.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

constexpr double kDistance = 0.01;  // m, of neighbouring points

/// Points of a lattice in a ball of `radius` distances, each moved at random by up to half `jitter` distances
/// an axis.
std::vector<std::array<float, 3>> ball(double radius, double jitter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.5 * jitter, 0.5 * jitter);
  std::vector<std::array<float, 3>> points;
  const int reach = static_cast<int>(radius) + 1;
  for (int i = -reach; i < reach; ++i)
    for (int j = -reach; j < reach; ++j)
      for (int k = -reach; k < reach; ++k) {
        const Vec3 x(i + 0.5, j + 0.5, k + 0.5);
        if (!(x.norm() < radius)) continue;
        const Vec3 moved = kDistance * (x + Vec3(shift(random), shift(random), shift(random)));
        points.push_back(
            {static_cast<float>(moved.x()), static_cast<float>(moved.y()), static_cast<float>(moved.z())});
      }
  return points;
}

/// Over the points' own volumes.
double volume_ratio(const TriangleMesh& mesh, std::size_t points) {
  return enclosed_volume(mesh.positions, mesh.triangles) /
         (static_cast<double>(points) * kDistance * kDistance * kDistance);
}

// A surface that lies off by e distances changes the volume of a ball of 12 by 3 e/12: 3 % is an eighth of a
// distance, the rounding of the lattice ball's own rim included.
TEST(Skin, OfABallEnclosesTheVolumeOfItsPoints) {
  const auto points = ball(12, 0);
  EXPECT_NEAR(volume_ratio(skin_of(points, kDistance, 2), points.size()), 1, 0.03);
}

// What the claim on a shaken foam's volume rests on: disorder by itself is not read as volume. Points that
// have lost all order within their places reach out up to half a distance more, and the surface follows them
// by less than a tenth of that: 3 * 0.05 / 12.
TEST(Skin, DoesNotGrowWhenPointsLoseTheirOrder) {
  const auto ordered = ball(12, 0), disordered = ball(12, 1);
  const double before = volume_ratio(skin_of(ordered, kDistance, 2), ordered.size());
  const double after = volume_ratio(skin_of(disordered, kDistance, 2), disordered.size());
  EXPECT_NEAR(after / before, 1, 0.05);
}

// The points of the lattice ball reach from 11 to 12 distances; a smooth surface stays within a distance of
// both. Where a layer of the lattice ends, the surface climbs one distance over about two, 27 degrees, and
// the points' jitter (a quarter of a distance up or down, from one to the next) adds 14: the normals stay
// within 45 degrees of the sphere's.
TEST(Skin, OfABallIsClosedRoundAndFacesOutward) {
  const TriangleMesh mesh = skin_of(ball(12, 0.5), kDistance, 2);
  MeshData data;
  data.positions = mesh.positions;
  data.triangles = mesh.triangles;
  data.face.assign(mesh.triangles.size(), 0);
  EXPECT_NO_THROW((void)closed_surface(data, "skin"));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 x(mesh.positions[i][0], mesh.positions[i][1], mesh.positions[i][2]);
    const Vec3 n(mesh.normals[i][0], mesh.normals[i][1], mesh.normals[i][2]);
    EXPECT_GT(x.norm(), 11 * kDistance);
    EXPECT_LT(x.norm(), 13 * kDistance);
    EXPECT_GT(n.dot(x.normalized()), std::cos(45 * M_PI / 180));
  }
}

TEST(Skin, IsTheSameForAnyNumberOfThreads) {
  const auto points = ball(14, 1);
  const TriangleMesh one = skin_of(points, kDistance, 1);
  for (const int threads : {2, 8}) {
    const TriangleMesh other = skin_of(points, kDistance, threads);
    EXPECT_EQ(other.positions, one.positions) << threads;
    EXPECT_EQ(other.normals, one.normals) << threads;
    EXPECT_EQ(other.triangles, one.triangles) << threads;
  }
}

// Deep points are left out of the work; a point's place in the surface must not show it: a ball with a hole
// inside has the hole's surface too.
TEST(Skin, KeepsAHollowInside) {
  std::vector<std::array<float, 3>> shell;
  for (const auto& p : ball(14, 0))
    if (std::hypot(p[0], p[1], p[2]) > 5 * kDistance) shell.push_back(p);
  EXPECT_NEAR(volume_ratio(skin_of(shell, kDistance, 2), shell.size()), 1, 0.05);
}

// A sphere of the volume of one point has a radius of 0.62 distances; the union's spheres end as 0.57 and
// smoothing takes some of that.
TEST(Skin, OfAPointAloneIsASmallSphere) {
  const TriangleMesh mesh = skin_of({{0.3F, 0.2F, 0.1F}}, kDistance, 1);
  ASSERT_FALSE(mesh.triangles.empty());
  for (const auto& p : mesh.positions) {
    const double r = (Vec3(p[0], p[1], p[2]) - Vec3(0.3, 0.2, 0.1)).norm() / kDistance;
    EXPECT_GT(r, 0.2);
    EXPECT_LT(r, 0.7);
  }
}

TEST(Skin, OfNoPointsIsEmpty) {
  EXPECT_TRUE(skin_of({}, kDistance, 1).triangles.empty());
}

TEST(Skin, IsMeasuredOnlyWhereTheSceneAsksForIt) {
  const std::string scene = testing_support::ball_scene();
  EXPECT_FALSE(testing_support::run(scene, {}).frames.back().skin_volume.has_value());
  const Report asked = testing_support::run(scene, {{"/look/style", "skin"}});
  ASSERT_TRUE(asked.frames.front().skin_volume.has_value());
  // A ball of radius 0.1 m at rest: as above, with the sphere's own volume and 8 distances of radius.
  EXPECT_NEAR(*asked.frames.front().skin_volume / (4.0 / 3 * M_PI * 1e-3), 1, 0.06);
  EXPECT_NE(to_json(asked).find("skin_volume"), std::string::npos);
}

TEST(Skin, OfAFrameIsTheSameAfterARestore) {
  const Plan plan =
      make_plan(parse_scene(testing_support::ball_scene(), "", {{"/output/skin", "[\"ply\"]"}}));
  const auto first = Simulation::create(plan, 1), second = Simulation::create(plan, 2);
  first->step_to_frame(1, [](const Progress&) { return true; });
  second->restore(first->save());
  const Frame a = first->frame(), b = second->frame();
  ASSERT_EQ(a.skins.size(), 1U);
  ASSERT_EQ(b.skins.size(), 1U);
  EXPECT_EQ(a.skins[0].mesh->positions, b.skins[0].mesh->positions);
  EXPECT_EQ(a.skins[0].volume, b.skins[0].volume);
  EXPECT_EQ(first->report().frames.back().skin_volume, second->report().frames.back().skin_volume);
}

}  // namespace
}  // namespace lather
