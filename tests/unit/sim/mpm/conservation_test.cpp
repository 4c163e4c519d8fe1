// What one step must keep: mass exactly, momenta to rounding, free fall to rounding. [Foam E.3]

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::ball_scene;
using testing_support::run;

struct Variant {
  const char* name;
  const char* transfer;
  const char* precision;
  const char* kernel;
  int dimension;
};
void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

double epsilon(const Variant& v) {
  return std::string(v.precision) == "float" ? std::numeric_limits<float>::epsilon()
                                             : std::numeric_limits<double>::epsilon();
}

std::vector<Override> overrides(const Variant& v) {
  return {{"/numerics/transfer", v.transfer},
          {"/numerics/precision", v.precision},
          {"/numerics/kernel", v.kernel},
          {"/dimension", std::to_string(v.dimension)}};
}

class Conservation : public testing::TestWithParam<Variant> {};

TEST_P(Conservation, MassIsExactAndMomentumKeptInFreeFlight) {
  auto set = overrides(GetParam());
  // A spinning, shearing ball: it wobbles, yields and stretches, nothing acts on it from outside.
  set.push_back({"/bodies/0/velocity", GetParam().dimension == 3 ? "[0.3, -0.2, 0.1]" : "[0.3, -0.2]"});
  set.push_back({"/bodies/0/spin_deg", "[0, 0, 700]"});
  set.push_back({"/bodies/0/velocity_gradient", "[[0, 8, 0], [0, 0, 0], [0, 0, 0]]"});
  const Report r = run(ball_scene(), set);
  ASSERT_EQ(r.frames.size(), 2U);
  const FrameMeasure& a = r.frames.front();
  const FrameMeasure& b = r.frames.back();
  ASSERT_EQ(r.steps, 400U);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.points, b.points);
  // Rounding of each step is independent from point to point and step to step: it grows as the square root of
  // their number; times 8 for the sums on the grid (64 terms). Scale: the mass times the largest speed.
  const double scale = a.mass * a.max_speed;
  const double bound = 8 * epsilon(GetParam()) * std::sqrt(400.0) * scale;
  EXPECT_LT((b.momentum - a.momentum).norm(), bound) << (b.momentum - a.momentum).norm() / scale;
  EXPECT_GT(std::abs(b.elastic_shear_energy), 0);
}

TEST_P(Conservation, FreeFallIsExact) {
  auto set = overrides(GetParam());
  set.push_back({"/gravity", "[0, -9.81, 0]"});
  set.push_back({"/numerics/time_step", "1e-3"});
  set.push_back({"/materials/0/bulk_modulus", "1000"});
  const Report r = run(ball_scene(), set);
  const double n = 100;
  ASSERT_EQ(r.steps, 100U);
  const double fallen = r.frames.back().center_of_mass.y() - r.frames.front().center_of_mass.y();
  const double exact = -9.81 * 1e-6 * n * (n + 1) / 2;  // symplectic Euler
  // The centre of mass is itself a sum over N points in double.
  const double sum_error = std::sqrt(static_cast<double>(r.frames.back().points)) *
                           std::numeric_limits<double>::epsilon() * r.frames.back().center_of_mass.norm();
  EXPECT_NEAR(fallen, exact, n * epsilon(GetParam()) * std::abs(exact) + sum_error);
}

TEST_P(Conservation, AngularMomentumIsKeptByApic) {
  if (std::string(GetParam().transfer) != "apic") {
    // FLIP/PIC keeps it only as far as its blend lets it: here it must at least not grow.
    auto set = overrides(GetParam());
    set.push_back({"/bodies/0/spin_deg", "[0, 0, 700]"});
    const Report r = run(ball_scene(), set);
    EXPECT_LT(r.frames.back().angular_momentum.norm(), r.frames.front().angular_momentum.norm() * (1 + 1e-6));
    return;
  }
  auto set = overrides(GetParam());
  set.push_back({"/bodies/0/spin_deg", GetParam().dimension == 3 ? "[300, 200, 700]" : "[0, 0, 700]"});
  set.push_back({"/bodies/0/velocity", "[0.3, -0.2, 0]"});
  const Report r = run(ball_scene(), set);
  const FrameMeasure& a = r.frames.front();
  const FrameMeasure& b = r.frames.back();
  // As for momentum; the arm is the distance from the origin, about a metre.
  const double scale = a.mass * a.max_speed * 1.0;
  EXPECT_LT((b.angular_momentum - a.angular_momentum).norm(),
            8 * epsilon(GetParam()) * std::sqrt(400.0) * scale)
      << (b.angular_momentum - a.angular_momentum).norm() / scale;
}

INSTANTIATE_TEST_SUITE_P(Variants, Conservation,
                         testing::Values(Variant{"FlipCubicFloat3D", "flip", "float", "cubic", 3},
                                         Variant{"ApicCubicFloat3D", "apic", "float", "cubic", 3},
                                         Variant{"FlipQuadraticDouble3D", "flip", "double", "quadratic", 3},
                                         Variant{"ApicQuadraticDouble3D", "apic", "double", "quadratic", 3},
                                         Variant{"ApicCubicDouble3D", "apic", "double", "cubic", 3},
                                         Variant{"FlipCubicDouble2D", "flip", "double", "cubic", 2},
                                         Variant{"ApicQuadraticFloat2D", "apic", "float", "quadratic", 2}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace lather
