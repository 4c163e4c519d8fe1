#include "sim/shape/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/shape/placement.h"

namespace lather::test {
namespace {

std::vector<std::pair<std::string, Motion>> motions() {
  Keyframes keys;
  keys.keys = {{0.2, {0.1, 0, 0}, {10, 20, 30}},
               {0.7, {0.4, -0.2, 0.1}, {90, -45, 10}},
               {1.0, {0.4, 0.3, 0.1}, {200, 80, -160}},
               {1.9, {0, 0, 0}, {0, 0, 0}}};
  return {{"rest", AtRest{}},
          {"linear", LinearMotion{{0.3, -0.1, 0.2}, 0.25, 1.5}},
          {"oscillation", Oscillation{{1, 2, 0}, 0.05, 3, 40, 0.1, 1.6}},
          {"rotation", Rotation{{0.2, 0.1, -0.3}, {1, 1, 0.5}, 270, 0.3, 1.4}},
          {"keyframes", keys}};
}

Vec3 moved(const Motion& motion, double t, const Vec3& x) {
  const Pose pose = pose_at(motion, t);
  return pose.rotation * x + pose.translation;
}

/// Times at which a velocity may jump.
bool near_a_joint(double t) {
  for (const double joint : {0.1, 0.2, 0.25, 0.3, 0.7, 1.0, 1.4, 1.5, 1.6, 1.9}) {
    if (std::abs(t - joint) < 1e-4) return true;
  }
  return false;
}

TEST(Motion, VelocityIsTheDerivativeOfThePlace) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> time(0, 2.2), place(-1, 1);
  for (const auto& [name, motion] : motions()) {
    for (int i = 0; i < 2'000; ++i) {
      const double t = time(random);
      if (near_a_joint(t)) continue;
      const Vec3 x(place(random), place(random), place(random));
      constexpr double kStep = 1e-5;
      const Vec3 slope = (moved(motion, t + kStep, x) - moved(motion, t - kStep, x)) / (2 * kStep);
      const Vec3 velocity = velocity_at(motion, t, moved(motion, t, x));
      ASSERT_LT((slope - velocity).norm(), 1e-6 * (1 + velocity.norm())) << name << " at " << t;
    }
  }
}

TEST(Motion, NeverJumps) {
  for (const auto& [name, motion] : motions()) {
    for (int i = 0; i < 22'000; ++i) {
      const Vec3 x(0.3, 0.2, -0.4);
      const double t = 1e-4 * i;
      ASSERT_LT((moved(motion, t + 1e-4, x) - moved(motion, t, x)).norm(), 5e-3) << name << " at " << t;
    }
  }
}

TEST(Motion, OtherThanKeyframesStartsWhereTheScenePutsTheObstacle) {
  for (const auto& [name, motion] : motions()) {
    if (name == "keyframes") continue;
    EXPECT_EQ((moved(motion, 0, {0.3, 0.2, 0.1}) - Vec3(0.3, 0.2, 0.1)).norm(), 0) << name;
  }
}

TEST(Motion, MaxSpeedBoundsEverySpeedAndIsNotFarAbove) {
  const Vec3 center(0.1, 0.4, -0.2);
  constexpr double kRadius = 0.3, kDuration = 1.2;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (const auto& [name, motion] : motions()) {
    const double bound = max_speed(motion, center, kRadius, kDuration);
    double fastest = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 x = center + kRadius * Vec3(normal(random), normal(random), normal(random)).normalized();
      const double t = kDuration * i / 20'000;
      fastest = std::max(fastest, velocity_at(motion, t, moved(motion, t, x)).norm());
    }
    EXPECT_LE(fastest, bound * (1 + 1e-12)) << name;
    EXPECT_GE(fastest, bound / 4) << name;
  }
  EXPECT_EQ(max_speed(LinearMotion{{1, 0, 0}, 5, 6}, center, kRadius, kDuration), 0)
      << "starts after the end";
}

TEST(Motion, KeyframesPassThroughTheirPlacesAndAreHeldOutside) {
  const Motion motion = motions().back().second;
  const auto& keys = std::get<Keyframes>(motion).keys;
  for (const Keyframe& key : keys) {
    const Vec3 x(0.2, -0.5, 0.3);
    const Vec3 expected = rotation_of(key.rotate_deg) * x + key.translate;
    EXPECT_LT((moved(motion, key.time, x) - expected).norm(), 1e-12) << key.time;
  }
  EXPECT_TRUE(moved(motion, 0, Vec3::Zero()).isApprox(keys.front().translate));
  EXPECT_EQ(velocity_at(motion, 0.1, {1, 2, 3}).norm(), 0);
  EXPECT_EQ(velocity_at(motion, 2.0, {1, 2, 3}).norm(), 0);
}

TEST(Motion, TwoKeyframesMakeSteadyMotion) {
  const Motion motion = Keyframes{{{0, {0, 0, 0}, Vec3::Zero()}, {2, {1, 0, 0}, Vec3::Zero()}}};
  for (const double t : {0.0, 0.5, 1.3, 1.99}) {
    EXPECT_TRUE(velocity_at(motion, t, Vec3::Zero()).isApprox(Vec3(0.5, 0, 0))) << t;
  }
}

TEST(Motion, ARotationTurnsByTheRightHandAboutItsAxis) {
  const Motion motion = Rotation{{1, 0, 0}, {0, 3, 0}, 90};
  EXPECT_TRUE(moved(motion, 1, {2, 0.5, 0}).isApprox(Vec3(1, 0.5, -1), 1e-14));
}

}  // namespace
}  // namespace lather::test
