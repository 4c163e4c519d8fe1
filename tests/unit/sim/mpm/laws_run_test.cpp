// Whole runs of the grid solver with other laws than foam's: the same bits every time, momenta and energy of
// elastic bodies, liquids at rest, steps that follow hardened moduli.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/law_scenes.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;
using testing_support::with_dimension;

/// All laws on a grid, with what only it has: water from above, probes.
std::string all_laws(int dimension) {
  return testing_support::all_laws(dimension, "", R"("look": {"color_by": "J"},
    "emitters": [{"name": "drops", "material": "water", "velocity": [0, -3, 0], "interval": 0.02, "count": 2,
                  "shape": {"type": "box", "size": [0.15, 0.15, 0.5], "translate": [0.6, 0.6, 0.2]}}],
    "probes": [{"type": "force", "name": "load", "obstacle": "peg"},
               {"type": "point", "name": "inside", "at": [0.55, 0.15, 0.2]}])");
}

/// Both dimensions, both transfers.
struct Variant {
  const char* name;
  int dimension;
  const char* transfer;
};
void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

class LawsOnTheGrid : public testing::TestWithParam<Variant> {
 protected:
  static std::vector<Override> as_asked() { return {{"/numerics/transfer", GetParam().transfer}}; }
};

TEST_P(LawsOnTheGrid, AreBitEqualForAnyNumberOfThreads) {
  const auto overrides = as_asked();
  const Report one = run(all_laws(GetParam().dimension), overrides, 1);
  const Report three = run(all_laws(GetParam().dimension), overrides, 3);
  ASSERT_EQ(one.frames.size(), three.frames.size());
  for (std::size_t i = 0; i < one.frames.size(); ++i) {
    EXPECT_TRUE(std::isfinite(one.frames[i].kinetic_energy));
    EXPECT_EQ(one.frames[i].fingerprint, three.frames[i].fingerprint);
  }
  EXPECT_EQ(one.steps, three.steps);
  for (std::size_t p = 0; p < one.probes.size(); ++p) EXPECT_EQ(one.probes[p].values, three.probes[p].values);
  const FrameMeasure& last = one.frames.back();
  EXPECT_GE(last.pieces, 1U);
  EXPECT_GT(last.points_emitted, 0U);
  EXPECT_EQ(last.points, one.frames.front().points + last.points_emitted);
}

TEST_P(LawsOnTheGrid, GoOnBitEqualAfterARestore) {
  testing_support::expect_bit_equal_after_restore(
      make_plan(parse_scene(all_laws(GetParam().dimension), "", as_asked())), 2, 3);
}

INSTANTIATE_TEST_SUITE_P(Variants, LawsOnTheGrid,
                         testing::Values(Variant{"Flip2D", 2, "flip"}, Variant{"Apic2D", 2, "apic"},
                                         Variant{"Flip3D", 3, "flip"}, Variant{"Apic3D", 3, "apic"}),
                         [](const auto& test) { return std::string(test.param.name); });

/// A block of a neo-Hookean solid of 4 x 6 (x 5) cells, free in a wide domain: T = 2 L / c = 60 ms for L =
/// 0.3 m, c = sqrt(E / rho) = 10 m/s.
std::string free_block(int dimension) {
  return with_dimension(R"({"lather": 1, "name": "block", "dimension": DIM,
    "domain": {"min": [-2, -2, -2], "max": [2, 2, 2], "boundary": "open"}, "gravity": [0, 0, 0],
    "duration": 0.3, "frame_rate": 50, "spacing": 0.05,
    "materials": [{"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e5,
                   "poisson_ratio": 0.3}],
    "bodies": [{"name": "block", "material": "jelly", "velocity": [0.3, -0.7, 0], "spin_deg": [0, 0, 100],
                "velocity_gradient": [[0, 0, 0], [0, 2, 0], [0, 0, 0]],
                "shape": {"type": "box", "size": [0.2, 0.3, 0.25], "translate": [0.5, 0.35, 0.025]}}],
    "numerics": {"precision": "double", "transfer": "apic", "kernel": "quadratic"}})",
                        dimension);
}

double energy(const FrameMeasure& f) {
  return f.kinetic_energy + f.elastic_volume_energy + f.elastic_shear_energy;
}

class ElasticBody : public testing::TestWithParam<int> {};

// Internal forces add up to nothing on the grid, and APIC carries angular momentum over: rounding is left, of
// some thousand sums.
TEST_P(ElasticBody, KeepsItsMomentaAndGainsNoEnergy) {
  const Report r = run(free_block(GetParam()));
  const FrameMeasure& first = r.frames.front();
  double strained = 0;
  for (const FrameMeasure& f : r.frames) {
    EXPECT_EQ(f.mass, first.mass);
    EXPECT_LT((f.momentum - first.momentum).norm(), 1e-12 * first.momentum.norm());
    EXPECT_LT((f.angular_momentum - first.angular_momentum).norm(), 1e-11 * first.angular_momentum.norm());
    EXPECT_LE(energy(f), energy(first) * (1 + 1e-3)) << f.time;
    strained = std::max(strained, f.elastic_shear_energy + f.elastic_volume_energy);
  }
  EXPECT_GT(strained, 1e-3 * energy(first));  // it swings
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ElasticBody, testing::Values(2, 3),
                         [](const auto& c) { return std::to_string(c.param) + "D"; });

/// A tank of water, 0.4 m wide and 0.2 m deep, at rest but for its own weight.
const char* const kTank =
    R"({"lather": 1, "name": "tank", "dimension": 2, "domain": {"min": [0, 0], "max": [0.4, 0.4]},
    "duration": 0.6, "frame_rate": 100, "spacing": 0.0125,
    "materials": [{"name": "water", "model": "liquid", "density": 1000, "bulk_modulus": 1e5, "bulk_viscosity": 150}],
    "bodies": [{"name": "water", "material": "water", "shape": {"type": "box", "size": [0.4, 0.2, 1], "translate": [0.2, 0.1]}}],
    "numerics": {"transfer": "apic", "kernel": "quadratic"},
    "probes": [{"type": "walls", "name": "tank"}, {"type": "point", "name": "middle", "at": [0.2, 0.1]}]})";

/// Mean of a column over the second half of a probe's samples: some four of the water's compressions, of 4 H
/// / c = 80 ms each.
double mean_of(const ProbeSeries& p, std::size_t column) {
  const std::size_t rows = p.times.size();
  const std::size_t first = rows / 2;
  double sum = 0;
  for (std::size_t row = first; row < rows; ++row) sum += p.values[row * p.columns.size() + column];
  return sum / static_cast<double>(rows - first);
}

TEST(LiquidOnTheGrid, PressesWithItsWeight) {
  const Report r = run(kTank);
  ASSERT_EQ(r.probes.at(1).columns.at(5).quantity, "pressure");
  EXPECT_NEAR(mean_of(r.probes.at(0), 1), -9.81 * 1000 * 0.4 * 0.2, 0.01 * 785);
  EXPECT_NEAR(mean_of(r.probes.at(1), 5), 9.81 * 1000 * 0.1, 0.03 * 981);
}

// The planned step is that of moduli at rest: exp(xi (1 - Jp)) times as stiff, snow needs shorter ones.
TEST(SnowOnTheGrid, ShortensTheStepAsItHardens) {
  const auto run_with = [](const char* hardening) {
    return run(R"({"lather": 1, "name": "snowball", "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1]},
        "duration": 0.05, "frame_rate": 20, "spacing": 0.05,
        "materials": [{"name": "snow", "model": "snow", "density": 400, "youngs_modulus": 1e5, "poisson_ratio": 0.2}],
        "bodies": [{"name": "ball", "material": "snow", "velocity": [0, -5, 0],
                    "shape": {"type": "sphere", "radius": 0.2, "translate": [0.5, 0.25, 0]}}]})",
               {{"/materials/0/hardening", hardening}});
  };
  EXPECT_GT(run_with("10").steps, 1.1 * static_cast<double>(run_with("0").steps));
}

}  // namespace
}  // namespace lather
