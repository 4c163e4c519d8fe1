// Whole runs of the MLSRK solver: bodies that fall, spin and swing, and the same bits every time.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/plan/plan.h"
#include "tests/support/law_scenes.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;
using testing_support::with_dimension;

/// A block of 4 x 6 (x 5) points of an elastic solid, free in a wide domain.
std::string free_block(int dimension) {
  return with_dimension(R"({"lather": 1, "name": "block", "solver": "mlsrk", "dimension": DIM,
    "domain": {"min": [-2, -2, -2], "max": [2, 2, 2], "boundary": "open"}, "gravity": [0, 0, 0],
    "duration": 0.2, "frame_rate": 10, "spacing": 0.05,
    "materials": [{"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e5,
                   "poisson_ratio": 0.3}],
    "bodies": [{"name": "block", "material": "jelly",
                "shape": {"type": "box", "size": [0.2, 0.3, 0.25], "translate": [0.5, 0.35, 0.025]}}],
    "numerics": {"precision": "double"}})",
                        dimension);
}

/// The particle method's foam does not tear.
std::string all_laws(int dimension) {
  return testing_support::all_laws(dimension, R"(, "tear_threshold": "infinity")", R"("solver": "mlsrk")");
}

class MlsrkRun : public testing::TestWithParam<int> {};

// Twice the steps cannot change a velocity that gravity alone makes; what is left is rounding.
TEST_P(MlsrkRun, AFreeBodyFallsWithGravity) {
  const Report r = run(free_block(GetParam()), {{"/gravity/1", "-9.81"}});
  for (const FrameMeasure& f : r.frames) {
    EXPECT_NEAR(f.momentum.y() / f.mass, -9.81 * f.time, 1e-6 * 9.81 * (f.time + 1e-9));
    EXPECT_NEAR(f.momentum.x(), 0, 1e-10 * f.mass);
  }
}

// A velocity that is blended with sum_j N_j u_j < u is dragged: the paper's Figure 9.
TEST_P(MlsrkRun, WithoutConstantConsistencyItFloats) {
  const Report r =
      run(free_block(GetParam()), {{"/gravity/1", "-9.81"}, {"/numerics/mlsrk/regularize_constant", "true"}});
  const FrameMeasure& f = r.frames.back();
  EXPECT_GT(f.momentum.y() / f.mass, -0.99 * 9.81 * f.time);
}

// Forces of eq. 11 add up to nothing before they are divided by the lumped mass; divided by the points' own,
// the momentum stays to rounding.
TEST_P(MlsrkRun, OwnMassesKeepTheMomentumOfASpinningBody) {
  const double spin = 200;  // degrees/s
  const std::vector<Override> spinning = {
      {"/bodies/0/spin_deg", GetParam() == 2 ? "[0, 0, 200]" : "[0, 200, 0]"},
      {"/bodies/0/velocity", "[0.3, -0.2, 0]"},
      {"/numerics/mlsrk/velocity_blend", "1"}};
  std::vector<Override> own = spinning;
  own.push_back({"/numerics/mlsrk/inertial_mass", "own"});
  const Report kept = run(free_block(GetParam()), own);
  const FrameMeasure& first = kept.frames.front();
  const FrameMeasure& last = kept.frames.back();
  const double scale = first.mass * 0.15 * spin * 3.14159265358979 / 180;  // of the points' momenta
  EXPECT_LT((last.momentum - first.momentum).norm(), 1e-11 * scale);
  EXPECT_LT((last.angular_momentum - first.angular_momentum).norm(), 0.01 * first.angular_momentum.norm());
  const Report lumped = run(free_block(GetParam()), spinning);
  const double drift = (lumped.frames.back().momentum - first.momentum).norm();
  EXPECT_LT(drift, 0.01 * scale);  // by symmetry of the block it is small, not nothing
}

// sum_i N_i = 1: the lumped masses are the points' own, dealt out anew; so a common velocity has the same
// momentum and energy with both.
TEST_P(MlsrkRun, LumpedMassesAddUpToTheMass) {
  const Report r =
      run(free_block(GetParam()), {{"/bodies/0/velocity", "[0.3, -0.2, 0]"}, {"/jitter", "0.3"}});
  for (const FrameMeasure& f : r.frames) {
    ASSERT_TRUE(f.lumped.has_value());
    EXPECT_NEAR(f.lumped->mass, f.mass, 1e-12 * f.mass);
    EXPECT_NEAR(f.lumped->momentum[0], 0.3 * f.mass, 1e-12 * f.mass);
    EXPECT_NEAR(f.lumped->momentum[1], -0.2 * f.mass, 1e-12 * f.mass);
    EXPECT_NEAR(f.lumped->kinetic_energy, f.kinetic_energy, 1e-12 * f.kinetic_energy);
  }
  EXPECT_NE(to_json(r).find("\"lumped\""), std::string::npos);
}

// Divided by the points' own masses, forces do the work that the points' energy loses: f_i . u_i sums to
// -V sigma : L. What is left is the step's error, which a symplectic step keeps bounded: velocities stand
// half a step off, so it is of first order, in the square 2 % at a tenth of the step's bound. 20 periods of
// the slowest stretching mode: T = 2 L / c, c = sqrt(E / rho) = 10 m/s for L = 0.3 m.
TEST_P(MlsrkRun, WithoutTheBlendAClosedBodyGainsNoEnergy) {
  const Report r =
      run(free_block(GetParam()), {{"/duration", "1.2"},
                                   {"/numerics/mlsrk/velocity_blend", "1"},
                                   {"/numerics/mlsrk/inertial_mass", "own"},
                                   {"/numerics/safety_factor", GetParam() == 2 ? "0.04" : "0.1"},
                                   {"/bodies/0/velocity_gradient", "[[0, 0, 0], [0, 1, 0], [0, 0, 0]]"},
                                   {"/bodies/0/velocity", "[0, -0.35, 0]"}});
  const auto energy = [](const FrameMeasure& f) {
    return f.kinetic_energy + f.elastic_volume_energy + f.elastic_shear_energy;
  };
  const double start = energy(r.frames.front());
  ASSERT_GT(start, 0);
  for (const FrameMeasure& f : r.frames) EXPECT_LE(energy(f), 1.01 * start) << f.time;
}

TEST_P(MlsrkRun, IsBitEqualForAnyNumberOfThreads) {
  for (const char* precision : {"float", "double"}) {
    const std::vector<Override> overrides = {{"/numerics/precision", precision}};
    const Report one = run(all_laws(GetParam()), overrides, 1);
    const Report three = run(all_laws(GetParam()), overrides, 3);
    ASSERT_EQ(one.frames.size(), three.frames.size());
    for (std::size_t i = 0; i < one.frames.size(); ++i) {
      EXPECT_EQ(one.frames[i].fingerprint, three.frames[i].fingerprint);
      EXPECT_EQ(one.frames[i].lumped.value().momentum, three.frames[i].lumped.value().momentum);
    }
    EXPECT_EQ(one.steps, three.steps);
  }
}

TEST_P(MlsrkRun, ARestoredRunGoesOnBitEqual) {
  testing_support::expect_bit_equal_after_restore(make_plan(parse_scene(all_laws(GetParam()))), 2, 6);
}

TEST_P(MlsrkRun, AllLawsStayFiniteAndKeepTheirMass) {
  const Report r = run(all_laws(GetParam()), {{"/duration", "0.1"}});
  for (const FrameMeasure& f : r.frames) {
    EXPECT_TRUE(std::isfinite(f.kinetic_energy));
    EXPECT_EQ(f.points, r.frames.front().points);
    EXPECT_DOUBLE_EQ(f.mass, r.frames.front().mass);
    EXPECT_GT(f.lowest.y(), -0.05);
  }
}

// A liquid that fills a periodic box has its volume at rest, at any support radius: a full lattice gives 1.
TEST(MlsrkVolumes, ComeFromNeighboursWhereTheyAreCorrected) {
  const std::string box = R"({"lather": 1, "name": "full", "solver": "mlsrk", "dimension": 2,
    "domain": {"min": [0, 0], "max": [0.8, 0.8], "periodic": [true, true, false]}, "gravity": [0, 0], "duration": 0.01,
    "frame_rate": 100, "spacing": 0.05,
    "materials": [{"name": "water", "model": "liquid", "density": 1000, "bulk_modulus": 1e5}],
    "bodies": [{"name": "water", "material": "water",
                "shape": {"type": "box", "size": [2, 2, 2], "translate": [0.4, 0.4, 0]}}]})";
  for (const char* radius : {"2", "2.5", "3"}) {
    const FrameMeasure f = run(box, {{"/numerics/mlsrk/support_radius", radius}}).frames.back();
    EXPECT_NEAR(f.min_volume_ratio, 1, 1e-5) << radius;
    EXPECT_NEAR(f.max_volume_ratio, 1, 1e-5) << radius;
  }
}

/// Snow thrown on the floor, which compacts and hardens, and a block that rests far above it, as stiff as
/// `youngs_modulus` (Pa), in 2D.
std::string crushed_snow(const std::string& youngs_modulus) {
  return R"({"lather": 1, "name": "crushed", "solver": "mlsrk", "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [0, 0], "max": [1, 1]}, "duration": 0.05, "frame_rate": 100, "spacing": 0.02,
    "materials": [
      {"name": "snow", "model": "snow", "density": 400, "youngs_modulus": 1e5, "poisson_ratio": 0.2},
      {"name": "block", "model": "neo-hookean", "density": 400, "poisson_ratio": 0.2, "youngs_modulus": )" +
         youngs_modulus + R"(}],
    "bodies": [
      {"name": "snow", "material": "snow", "shape": {"type": "box", "size": [0.2, 0.1, 1], "translate": [0.5, 0.06, 0]},
       "velocity": [0, -3, 0]},
      {"name": "block", "material": "block", "shape": {"type": "box", "size": [0.1, 0.1, 1], "translate": [0.5, 0.8, 0]}}]})";
}

// Steps are bound by the fastest wave: that of the hardened snow beside a soft block, that of the block where
// its waves are 6.3 times as fast as fresh snow's, which the hardened snow's are not.
TEST(MlsrkStep, ShortensForHardenedPointsOnlyWhereTheirWavesAreTheFastest) {
  const auto steps_over_planned = [](const std::string& youngs_modulus) {
    const std::string scene = crushed_snow(youngs_modulus);
    return static_cast<double>(run(scene).steps) / static_cast<double>(make_plan(parse_scene(scene)).steps);
  };
  EXPECT_GT(steps_over_planned("1e4"), 1.3);
  EXPECT_EQ(steps_over_planned("4e6"), 1);
}

// A single point has no neighbours: no moment matrix of rank, no gradient, nothing but gravity.
TEST_P(MlsrkRun, AnIsolatedPointFallsFreely) {
  for (const char* r0 : {"0", "1e-3"}) {
    const Report r = run(free_block(GetParam()), {{"/gravity/1", "-9.81"},
                                                  {"/bodies/0/shape/size", "[0.04, 0.04, 0.06]"},
                                                  {"/bodies/0/shape/translate", "[0.525, 0.525, 0.025]"},
                                                  {"/numerics/mlsrk/regularization", r0}});
    ASSERT_EQ(r.frames.front().points, 1U);
    const FrameMeasure& f = r.frames.back();
    EXPECT_NEAR(f.momentum.y() / f.mass, -9.81 * f.time, 1e-12 * 9.81);
    EXPECT_EQ(f.min_volume_ratio, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, MlsrkRun, testing::Values(2, 3),
                         [](const auto& c) { return std::to_string(c.param) + "D"; });

}  // namespace
}  // namespace lather
