// What the cone of Drucker and Prager means: friction angles in Mohr and Coulomb's sense, cohesion, gaps that
// open and close. [MLSRK section 4.3.4]

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/material/drucker_prager_make.h"
#include "sim/material/law_points.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

DruckerPragerParameters sand(double friction_angle_deg, FrictionMatch match, double cohesion = 0) {
  DruckerPragerParameters p;
  p.elastic = {1600, 3.5e5, 0.3};
  p.friction_angle_deg = friction_angle_deg;
  p.match = match;
  p.cohesion = cohesion;
  return p;
}

/// A point without rotations: the diagonal of F_e - I.
template <class Real>
struct Diagonal {
  std::array<Real, 9> G = {};
  Real plastic_volume = 0;

  Diagonal(Real x, Real y, Real z) {
    G[0] = x;
    G[4] = y;
    G[8] = z;
  }
  void yield(KernelLevel level, const DruckerPragerParameters& p, int dimension) {
    law_point_kernels<Real>(level).wide.drucker_prager(drucker_prager_constants<Real>(p, dimension),
                                                       dimension, 1, G.data(), &plastic_volume);
  }
  /// Stretches times F_e's.
  void stretch(Real x, Real y, Real z) {
    G[0] += x + x * G[0];
    G[4] += y + y * G[4];
    G[8] += z + z * G[8];
  }
};

/// The friction angle in Mohr and Coulomb's sense, degrees, of the logarithmic strains of a yielding state:
/// sin phi = (tau_1 - tau_2)/-(tau_1 + tau_2) of the stresses in x and y, 2 mu eps + lambda tr eps I. [the
/// stress for which MLSRK eq. 28 is the cone]
double acting_angle(const DruckerPragerParameters& p, const Diagonal<double>& point) {
  const double x = std::log1p(point.G[0]);
  const double y = std::log1p(point.G[4]);
  const double z = std::log1p(point.G[8]);
  const double pressure = p.elastic.lame_lambda() * (x + y + z);
  const double tau_x = 2 * p.elastic.lame_mu() * x + pressure;
  const double tau_y = 2 * p.elastic.lame_mu() * y + pressure;
  return std::asin((tau_x - tau_y) / -(tau_x + tau_y)) * kDegrees;
}

class DruckerPrager : public testing::TestWithParam<KernelLevel> {};

TEST_P(DruckerPrager, InTriaxialCompressionTheAngleIsTheGivenOne) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression);
  Diagonal<double> point(0.04, -0.12, 0.04);  // y is pressed hardest, x and z alike
  point.yield(GetParam(), p, 3);
  EXPECT_NEAR(acting_angle(p, point), 30, 1e-9);
}

TEST_P(DruckerPrager, MatchedInPlaneStrainTheAngleIsTheGivenOneInBothDimensions) {
  const auto p = sand(30, FrictionMatch::kPlaneStrain);
  Diagonal<double> plane(0.04, -0.12, 0);
  plane.yield(GetParam(), p, 2);
  EXPECT_NEAR(acting_angle(p, plane), 30, 1e-9);
  // In three dimensions flow in the plane takes the strain across it to the middle.
  Diagonal<double> solid(std::expm1(0.08), std::expm1(-0.16), std::expm1(-0.04));
  solid.yield(GetParam(), p, 3);
  EXPECT_NEAR(acting_angle(p, solid), 30, 1e-9);
}

TEST_P(DruckerPrager, ThePapersAngleActsDifferentlyInPlaneStrain) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression);
  Diagonal<double> plane(0.04, -0.12, 0);
  plane.yield(GetParam(), p, 2);
  EXPECT_NEAR(acting_angle(p, plane), 27.5, 0.05);
  Diagonal<double> solid(std::expm1(0.08), std::expm1(-0.16), std::expm1(-0.04));
  solid.yield(GetParam(), p, 3);
  EXPECT_NEAR(acting_angle(p, solid), 43.9, 0.05);
}

TEST_P(DruckerPrager, PressureAloneNeverYields) {
  for (const double angle : {0.0, 30.0}) {
    Diagonal<float> point(-0.125F, -0.125F, -0.125F);
    const Diagonal<float> before = point;
    point.yield(GetParam(), sand(angle, FrictionMatch::kTriaxialCompression), 3);
    EXPECT_EQ(point.G, before.G) << angle;
    EXPECT_EQ(point.plastic_volume, 0) << angle;
  }
}

TEST_P(DruckerPrager, WithoutFrictionAndCohesionOnlyPressureIsBorne) {
  Diagonal<double> point(0.1, -0.2, -0.05);
  const double J = 1.1 * 0.8 * 0.95;
  point.yield(GetParam(), sand(0, FrictionMatch::kTriaxialCompression), 3);
  for (const int i : {0, 4, 8}) EXPECT_NEAR(1 + point.G[static_cast<std::size_t>(i)], std::cbrt(J), 1e-14);
}

TEST_P(DruckerPrager, CohesionBearsItsStrainInTensionAndNoMore) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression, 0.02);
  Diagonal<double> below(0.015, 0.015, 0.015);
  below.yield(GetParam(), p, 3);
  EXPECT_EQ(below.G[0], 0.015);
  EXPECT_EQ(below.plastic_volume, 0);
  Diagonal<double> beyond(0.05, 0.05, 0.05);
  beyond.yield(GetParam(), p, 3);
  for (const int i : {0, 4, 8}) EXPECT_NEAR(beyond.G[static_cast<std::size_t>(i)], std::expm1(0.02), 1e-15);
  EXPECT_NEAR(beyond.plastic_volume, std::expm1(3 * (std::log1p(0.05) - 0.02)), 1e-14);
}

TEST_P(DruckerPrager, AGapClosesBeforeItBearsPressure) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression);
  Diagonal<double> point(0, 0, 0);
  point.stretch(0.1, 0.1, 0.1);
  point.yield(GetParam(), p, 3);
  EXPECT_NEAR(point.G[0], 0, 1e-15);  // no stress in tension
  point.stretch(-0.05, -0.05, -0.05);
  point.yield(GetParam(), p, 3);
  EXPECT_NEAR(point.G[0], 0, 1e-15);  // half closed: still none
  point.stretch(-0.05, -0.05, -0.05);
  point.yield(GetParam(), p, 3);
  EXPECT_NEAR(point.G[0], 1.1 * 0.95 * 0.95 - 1, 1e-14);  // more than closed: all that is beyond
  EXPECT_EQ(point.plastic_volume, 0);
}

TEST_P(DruckerPrager, AFlyingGrainKeepsItsVolumeOverManySteps) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression, 0.02);
  Diagonal<float> point(0.3F, 0.25F, 0.2F);
  const double J = 1.3 * 1.25 * 1.2;
  for (int step = 0; step < 100'000; ++step) point.yield(GetParam(), p, 3);
  const double J_e = (1 + double{point.G[0]}) * (1 + double{point.G[4]}) * (1 + double{point.G[8]});
  EXPECT_NEAR(J_e * (1 + double{point.plastic_volume}) / J, 1, 2e-6);  // as after one step: it settles
}

TEST_P(DruckerPrager, SmallStrainsKeepTheirDigitsInFloat) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression);
  Diagonal<float> point(1e-6F, -3e-6F, 0.5e-6F);
  Diagonal<double> exact(1e-6, -3e-6, 0.5e-6);
  point.yield(GetParam(), p, 3);
  exact.yield(GetParam(), p, 3);
  for (const std::size_t i : {0U, 4U, 8U}) EXPECT_NEAR(double{point.G[i]}, exact.G[i], 1e-12) << i;
  EXPECT_GT(std::abs(exact.G[0] - 1e-6), 1e-8);  // it slid
}

TEST_P(DruckerPrager, InTwoDimensionsNothingHappensAcrossThePlane) {
  const auto p = sand(30, FrictionMatch::kTriaxialCompression, 0.01);
  for (const double x : {-0.3, 0.2, 4.0}) {
    Diagonal<double> point(x, -0.25, 0);
    point.G[1] = 0.1;
    point.plastic_volume = 0.05;
    point.yield(GetParam(), p, 2);
    for (const std::size_t i : {2U, 5U, 6U, 7U, 8U}) EXPECT_EQ(point.G[i], 0) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, DruckerPrager, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
