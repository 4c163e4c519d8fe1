// Concentrations that diffuse between points, and what changes with them [MLSRK sections 4.2, 4.3.5].

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/plan/plan.h"
#include "tests/support/law_scenes.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;
using testing_support::with_dimension;

/// A dry and a wet block of jelly that meet, and a stone between them that takes no part.
std::string three_blocks(int dimension) {
  return with_dimension(R"({"lather": 1, "name": "blocks", "solver": "mlsrk", "dimension": DIM,
    "domain": {"min": [-1, -1, -1], "max": [1, 1, 1], "boundary": "open"}, "gravity": [0, 0, 0],
    "duration": 0.05, "frame_rate": 100, "spacing": 0.05, "jitter": 0.3, "seed": 3,
    "materials": [
      {"name": "dry", "model": "neo-hookean", "density": 500, "youngs_modulus": 2e4, "poisson_ratio": 0.3,
       "phase": {"concentration": 0, "mobility": 0.01}},
      {"name": "wet", "model": "neo-hookean", "density": 1000, "youngs_modulus": 2e4, "poisson_ratio": 0.3,
       "phase": {"concentration": 1, "mobility": 0.02}},
      {"name": "stone", "model": "neo-hookean", "density": 2000, "youngs_modulus": 4e4, "poisson_ratio": 0.3}],
    "bodies": [
      {"name": "dry", "material": "dry", "velocity": [0.5, 0, 0],
       "shape": {"type": "box", "size": [0.25, 0.3, 0.2], "translate": [-0.13, 0, 0.01]}},
      {"name": "wet", "material": "wet", "velocity": [-0.5, 0.2, 0],
       "shape": {"type": "box", "size": [0.25, 0.3, 0.2], "translate": [0.13, 0, 0.01]}},
      {"name": "stone", "material": "stone",
       "shape": {"type": "box", "size": [0.3, 0.1, 0.2], "translate": [0, 0.22, 0.01]}}],
    "numerics": {"precision": "double"}})",
                        dimension);
}

const PhaseMeasure& last(const Report& r) {
  return r.frames.back().phases.value();
}
double mass_drift(const Report& r) {
  const double start = r.frames.front().phases.value().component_mass;
  return std::abs(last(r).component_mass / start - 1);
}

class Phases : public testing::TestWithParam<int> {};

// Single rounding errors of 1e-16, or of 6e-8 that float kernels make of the change of c, which is some
// thousandth a step, add up to no more than these over the 100 steps.
TEST_P(Phases, KeepTheMassOfAComponentWherePointsMoveBesideWhatTakesNoPart) {
  const Report r = run(three_blocks(GetParam()));
  EXPECT_LT(mass_drift(r), 1e-13);
  EXPECT_GT(last(r).least, -0.1);
  EXPECT_LT(mass_drift(run(three_blocks(GetParam()), {{"/numerics/precision", "float"}})), 1e-7);
}

// [MLSRK Figure 5] What balances something else does not keep the mass.
TEST_P(Phases, OtherBalancesDoNotKeepIt) {
  for (const char* balance : {"lumped-mass", "concentration"}) {
    const Report r = run(three_blocks(GetParam()), {{"/numerics/mlsrk/phases/balance", balance}});
    EXPECT_GT(mass_drift(r), 1e-3) << balance;
  }
}

/// A periodic box full of two elastic halves.
std::string halves(const std::string& dry_phase, const std::string& wet_phase) {
  return R"({"lather": 1, "name": "halves", "solver": "mlsrk", "dimension": 2,
    "domain": {"min": [0, 0], "max": [0.8, 0.4], "periodic": [true, true, false]}, "gravity": [0, 0],
    "duration": 0.5, "frame_rate": 10, "spacing": 0.05,
    "materials": [
      {"name": "dry", "model": "neo-hookean", "density": 500, "youngs_modulus": 1e3, "poisson_ratio": 0.3,
       "phase": )" +
         dry_phase + R"(},
      {"name": "wet", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e3, "poisson_ratio": 0.3,
       "phase": )" +
         wet_phase + R"(}],
    "bodies": [
      {"name": "dry", "material": "dry", "shape": {"type": "box", "size": [0.4, 0.4, 1], "translate": [0.2, 0.2, 0]}},
      {"name": "wet", "material": "wet", "shape": {"type": "box", "size": [0.4, 0.4, 1], "translate": [0.6, 0.2, 0]}}],
    "numerics": {"precision": "double"}})";
}

// The slowest mode, k = 2 pi / 0.8, fades at L (2 k^2 + eps^2 k^4), 2 k^2 L = 12/s at the least. Those that
// alternate from point to point have hardly a gradient and are slower; the step between the halves has few.
TEST(Phase, EndsMixedAtTheMeanByMass) {
  const std::string phase = R"({"concentration": 0, "mobility": 0.1})";
  const Report r = run(halves(phase, R"({"concentration": 1, "mobility": 0.1})"), {{"/duration", "2"}});
  EXPECT_NEAR(last(r).least, 2.0 / 3, 0.01);
  EXPECT_NEAR(last(r).largest, 2.0 / 3, 0.01);
}

// c^2 (1 - c)^2 has its ends at 0 and 1, and a slope of -1/2 at c = 1/2: what is nearly mixed parts, with the
// interface's width below the halves'.
TEST(Phase, PartsInADoubleWell) {
  const std::vector<Override> well = {{"/numerics/mlsrk/phases/free_energy", "double-well"},
                                      {"/numerics/mlsrk/phases/interface_width", "0.03"},
                                      {"/materials/0/density", "1000"},
                                      {"/duration", "1"}};
  const Report r = run(
      halves(R"({"concentration": 0.45, "mobility": 0.1})", R"({"concentration": 0.55, "mobility": 0.1})"),
      well);
  EXPECT_LT(last(r).least, 0.1);
  EXPECT_GT(last(r).largest, 0.9);
  EXPECT_LT(mass_drift(r), 1e-13);
}

// Random points of c = 0 and c = 1 hold the sharpest modes there are. The diffusion's own bound limits the
// step: the material is slower. Modes that alternate from point to point have no gradient and stay; none
// may grow, which at an unstable step they do by orders of magnitude.
TEST(Phase, IsStableAtTheStepBoundWhateverItStartsFrom) {
  const std::vector<Override> mixed = {
      {"/materials/0/youngs_modulus", "1e-1"},
      {"/materials/1/youngs_modulus", "1e-1"},
      {"/materials/0/density", "1000"},
      {"/jitter", "0.5"},
      {"/numerics/safety_factor", "1"},
      {"/bodies",
       R"([{"name": "all", "mixture": [{"material": "dry", "share": 1}, {"material": "wet", "share": 1}],
            "shape": {"type": "box", "size": [0.8, 0.4, 1], "translate": [0.4, 0.2, 0]}}])"}};
  const Report r = run(
      halves(R"({"concentration": 0, "mobility": 0.1})", R"({"concentration": 1, "mobility": 0.1})"), mixed);
  EXPECT_LT(r.steps, 1000U) << "something else limits the step";
  for (const FrameMeasure& f : r.frames) {
    EXPECT_GT(f.phases.value().least, -0.5);
    EXPECT_LT(f.phases.value().largest, 1.5);
  }
}

/// Two free elastic halves that swell or shrink as they mix.
std::string free_halves(const char* density) {
  const std::string phase =
      R"(, "mobility": 0.2, "by_concentration": {"density": )" + std::string(density) + "}}";
  std::string json = halves(R"({"concentration": 0)" + phase, R"({"concentration": 1)" + phase);
  for (const char* given : {R"("density": 500, )", R"("density": 1000, )"})
    json.replace(json.find(given), std::string(given).size(), "");
  return json;
}

// Nothing but the concentrations themselves shows it: here no law reads them.
TEST(Phase, ThatGrowsWithoutBoundEndsTheRun) {
  const std::string fast = R"({"concentration": 0, "mobility": 10})";
  const std::string scene = halves(fast, R"({"concentration": 1, "mobility": 10})");
  EXPECT_THROW(run(scene, {{"/numerics/time_step", "1e-3"}, {"/duration", "1"}}), SimulationError);
}

// The mass is 320 kg/m from the start, rho = 1000 kg/m^3 at both ends of c and 800 in the middle, where all
// goes: the area grows by 25 %. Its size is read off the outermost points, to which half a spacing belongs,
// swollen like the rest.
TEST(Phase, SwellsToTheDensityOfItsConcentration) {
  const Report r = run(free_halves(R"({"type": "table", "points": [[0, 1000], [0.5, 800], [1, 1000]]})"),
                       {{"/domain", R"({"min": [-1, -1], "max": [2, 1], "boundary": "open"})"},
                        {"/numerics/mlsrk/velocity_blend", "0.5"},
                        {"/duration", "1"}});
  ASSERT_NEAR(r.frames.front().phases.value().rest_volume, 0.32, 1e-9);
  EXPECT_NEAR(last(r).rest_volume, 0.4, 0.001);
  const auto area = [](const FrameMeasure& f, double spacing) {
    const Vec3 extent = f.highest - f.lowest;
    return (extent.x() + spacing) * (extent.y() + spacing);
  };
  EXPECT_NEAR(area(r.frames.front(), 0.05), 0.32, 1e-6);
  EXPECT_NEAR(area(r.frames.back(), 0.05 * std::sqrt(1.25)), 0.4, 0.01 * 0.4);
}

/// One body of every law, with a parameter that the concentration changes, and the same with that parameter
/// as it is at c = 1/2.
struct Changing {
  const char* law;
  const char* key;
  const char* curve;
  const char* value;
};
class ParameterByConcentration : public testing::TestWithParam<Changing> {};

// A table has 1/2 as one of its nodes, so that the two runs differ by rounding alone.
TEST_P(ParameterByConcentration, ActsAsTheParameterItIsThere) {
  const Changing& p = GetParam();
  const auto scene = [&](const std::string& parameter) {
    return R"({"lather": 1, "name": "parameter", "solver": "mlsrk", "dimension": 2,
      "domain": {"min": [-1, 0], "max": [1, 1]}, "duration": 0.1, "frame_rate": 20, "spacing": 0.05,
      "materials": [{"name": "stuff", )" +
           std::string(p.law) + parameter + R"(}],
      "bodies": [{"name": "block", "material": "stuff", "velocity": [0.3, -1, 0],
                  "velocity_gradient": [[0.5, 1, 0], [0, -0.5, 0], [0, 0, 0]],
                  "shape": {"type": "box", "size": [0.4, 0.3, 1], "translate": [0, 0.2, 0]}}],
      "numerics": {"precision": "double", "time_step": 5e-4}})";
  };
  const std::string name = std::string("\"") + p.key + "\": ";
  const Report changing = run(scene(
      R"(, "phase": {"concentration": 0.5, "mobility": 0, "by_concentration": {)" + name + p.curve + "}}"));
  const Report fixed = run(scene(", " + name + p.value));
  const FrameMeasure& a = changing.frames.back();
  const FrameMeasure& b = fixed.frames.back();
  EXPECT_LT((a.center_of_mass - b.center_of_mass).norm(), 1e-9);
  EXPECT_LT((a.lowest - b.lowest).norm() + (a.highest - b.highest).norm(), 1e-7);
  EXPECT_NEAR(a.kinetic_energy, b.kinetic_energy, 1e-6 * b.kinetic_energy);
  EXPECT_NEAR(a.elastic_shear_energy, b.elastic_shear_energy, 1e-5 * b.elastic_shear_energy + 1e-9);
}

constexpr Changing kChanging[] = {
    {R"("model": "herschel-bulkley", "density": 100, "bulk_modulus": 1e4, "shear_modulus": 1e3, "flow_index": 0.5,
        "viscosity": 20)",
     "yield_stress", R"({"type": "smoothstep", "from": 0.2, "to": 0.8, "start": 100, "end": 20})", "60"},
    {R"("model": "neo-hookean", "density": 1000, "poisson_ratio": 0.3)", "youngs_modulus",
     R"({"type": "table", "points": [[0, 1e5], [0.4, 3e4], [0.6, 1e4]]})", "2e4"},
    {R"("model": "drucker-prager", "density": 1500, "youngs_modulus": 1e5, "poisson_ratio": 0.2)",
     "friction_angle_deg", R"({"type": "polynomial", "coefficients": [40, -20]})", "30"},
    {R"("model": "snow", "density": 400, "youngs_modulus": 1e5, "poisson_ratio": 0.2)", "hardening",
     R"({"type": "polynomial", "coefficients": [0, 0, 40]})", "10"},
    {R"("model": "liquid", "density": 1000, "bulk_modulus": 1e4)", "viscosity",
     R"({"type": "table", "points": [[0, 0], [1, 20]]})", "10"}};
INSTANTIATE_TEST_SUITE_P(Laws, ParameterByConcentration, testing::ValuesIn(kChanging));

TEST_P(Phases, AreBitEqualForAnyNumberOfThreads) {
  for (const char* precision : {"float", "double"}) {
    const std::vector<Override> overrides = {{"/numerics/precision", precision}, {"/duration", "0.02"}};
    const Report one = run(three_blocks(GetParam()), overrides, 1);
    const Report three = run(three_blocks(GetParam()), overrides, 3);
    ASSERT_EQ(one.frames.size(), three.frames.size());
    for (std::size_t i = 0; i < one.frames.size(); ++i)
      EXPECT_EQ(one.frames[i].fingerprint, three.frames[i].fingerprint);
  }
}

TEST_P(Phases, GoOnBitEqualAfterRestore) {
  testing_support::expect_bit_equal_after_restore(make_plan(parse_scene(three_blocks(GetParam()))), 2, 4);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Phases, testing::Values(2, 3));

TEST(Phase, CostsNothingWhereNoMaterialHasOne) {
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto fields = [](const PlannedMaterial& m) {
    std::vector<std::string> names;
    for (const PlannedField& f : m.fields) names.push_back(f.name);
    return names;
  };
  const Plan with = make_plan(parse_scene(three_blocks(3)));
  EXPECT_TRUE(has(with.stages, "phases"));
  EXPECT_TRUE(has(fields(with.materials[0]), "concentration"));
  EXPECT_FALSE(has(fields(with.materials[2]), "concentration"));
  const Plan without = make_plan(
      parse_scene(three_blocks(3), "", {{"/materials/0/phase", "null"}, {"/materials/1/phase", "null"}}));
  EXPECT_FALSE(has(without.stages, "phases"));
  for (const PlannedMaterial& m : without.materials) EXPECT_FALSE(has(fields(m), "concentration"));
  EXPECT_LT(without.materials[0].bytes_per_point, with.materials[0].bytes_per_point);
}

// Waves are as fast as the stiffest concentration lets them be.
TEST(Phase, LimitsTheStepByTheStiffestConcentration) {
  const std::string scene = halves(
      R"({"concentration": 0, "mobility": 1e-6, "by_concentration": {"youngs_modulus": {"type": "table", "points": [[0, 1e3], [1, 1e5]]}}})",
      R"({"concentration": 0, "mobility": 1e-6})");
  std::string by_c = scene;
  const std::string given = R"("youngs_modulus": 1e3, )";
  by_c.replace(by_c.find(given), given.size(), "");
  const double slow = make_plan(parse_scene(halves(R"({"concentration": 0, "mobility": 1e-6})",
                                                   R"({"concentration": 0, "mobility": 1e-6})")))
                          .step_bound;
  EXPECT_NEAR(make_plan(parse_scene(by_c)).step_bound, slow / 10, 1e-9);
}

}  // namespace
}  // namespace lather
