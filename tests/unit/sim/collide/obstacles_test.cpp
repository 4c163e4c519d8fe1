// Obstacles near a place, wherever they have moved to.

#include "sim/collide/obstacles.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace lather {
namespace {

/// Shapes whose distances are exact: bounded ones, a half space, one cut off by a half space; at rest and
/// moving.
Scene scene_of_obstacles() {
  return parse_scene(R"({
    "lather": 1, "duration": 1, "spacing": 0.1,
    "domain": {"min": [-1, -1, -1], "max": [1, 1, 1]},
    "materials": [{"name": "foam", "preset": "shaving-cream"}],
    "bodies": [{"name": "ball", "material": "foam", "shape": {"type": "sphere", "radius": 0.2}}],
    "obstacles": [
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.3, "translate": [0.5, 0, 0.2]}},
      {"name": "ground", "shape": {"type": "plane", "normal": [0.3, 1, 0], "translate": [0, -0.8, 0]}},
      {"name": "pin", "shape": {"type": "cylinder", "radius": 0.1, "height": 3, "rotate_deg": [90, 0, 0]}},
      {"name": "comes in", "shape": {"type": "box", "size": [0.5, 0.2, 0.4], "rotate_deg": [10, 20, 30], "translate": [-4, 0, 0]},
       "motion": {"type": "linear", "velocity": [4, 0, 0]}},
      {"name": "turns", "shape": {"type": "box", "size": [0.2, 0.2, 1], "translate": [0, 0.6, 0]},
       "motion": {"type": "rotation", "center": [0, 0, 0], "axis": [0, 0, 1], "rate_deg": 90}},
      {"name": "lowered", "shape": {"type": "plane", "normal": [0, -1, 0], "translate": [0, 3, 0]},
       "motion": {"type": "linear", "velocity": [0, -3, 0]}}
    ]})",
                     "");
}

TEST(Obstacles, NearAPlaceAreThoseWithinTheRadius) {
  const Scene scene = scene_of_obstacles();
  Obstacles obstacles(scene, scene.spacing);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  for (const double time : {0.0, 0.4, 1.0}) {
    obstacles.place(time, 1e-3);
    std::size_t found = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 x(coordinate(random), coordinate(random), coordinate(random));
      const double radius = 0.25 * (n % 3);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < scene.obstacles.size(); ++i) {
        const Pose pose = pose_at(scene.obstacles[i].motion, time);
        const Vec3 local = pose.rotation.conjugate() * (x - pose.translation);
        if (distance(*scene.obstacles[i].shape, local) < radius) expected.push_back(i);
      }
      std::vector<std::uint32_t> near;
      obstacles.find_near(x, radius, near);
      ASSERT_EQ(near, expected) << time << ": " << x.transpose() << " within " << radius;
      found += near.size();
    }
    EXPECT_GT(found, 500U);
  }
}

/// Velocity after contact with the walls of the scene above, of a point that then moves for `ahead` (s); none
/// where nothing changes.
std::optional<Vec3> after_walls(const std::string& boundary, const Vec3& x, Vec3 velocity, double ahead) {
  Scene scene = scene_of_obstacles();
  scene.domain.boundary = boundary == "stick" ? Boundary::kStick : Boundary::kSlip;
  const WatchedContacts nobody;
  const bool changed = Walls(scene).resolve(x, velocity, 1, ContactSink(nobody, nullptr), 0, ahead);
  return changed ? std::optional<Vec3>(velocity) : std::nullopt;
}

TEST(Walls, APointComesToAFaceAndNoFarther) {
  const Vec3 before_both(-0.98, 0.99, 0);  // 0.02 m before one face, 0.01 m before another
  EXPECT_FALSE(after_walls("slip", before_both, {-1, 0.5, 0}, 0.01));
  EXPECT_FALSE(after_walls("slip", before_both, {1, -0.5, 0}, 0.1));
  EXPECT_TRUE(after_walls("slip", before_both, {-1, 0.5, 0.3}, 0.1).value().isApprox(Vec3(-0.2, 0.1, 0.3)));
  EXPECT_TRUE(after_walls("stick", before_both, {-1, 0, 0.3}, 0.1).value().isApprox(Vec3(-0.2, 0, 0)));
  EXPECT_FALSE(after_walls("stick", before_both, {-0.1, 0, 0.3}, 0.1));
}

TEST(Walls, HoldWhatIsAtThem) {
  const Vec3 at(-1, 0, 0);
  EXPECT_TRUE(after_walls("slip", at, {-1, 0.5, 0}, 0).value().isApprox(Vec3(0, 0.5, 0)));
  EXPECT_TRUE(after_walls("slip", at, {-1, 0.5, 0}, 0.1).value().isApprox(Vec3(0, 0.5, 0)));
  EXPECT_FALSE(after_walls("slip", at, {1, 0.5, 0}, 0.1));
  EXPECT_TRUE(after_walls("stick", at, {1, 0.5, 0}, 0).value().isZero());
  EXPECT_TRUE(after_walls("stick", at, {-1, 0.5, 0}, 0.1).value().isZero());
}

}  // namespace
}  // namespace lather
