// Plans of the MLSRK solver: fields by material law, stages, the step's bounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/plan/plan.h"
#include "sim/plan/step_bound.h"
#include "tests/support/law_scenes.h"

namespace lather {
namespace {

using testing_support::kJelly;
using testing_support::kSand;
using testing_support::kSnow;
using testing_support::kWater;

/// A ball of one material at 10 mm in free space; `law` are the material's keys.
std::string ball_of(const std::string& law) {
  return R"({"lather": 1, "solver": "mlsrk",
    "domain": {"min": [-1, -1, -1], "max": [1, 1, 1], "boundary": "open"}, "duration": 0.1, "frame_rate": 10,
    "spacing": 0.01, "materials": [{"name": "m", )" +
         law + R"(}],
    "bodies": [{"name": "ball", "material": "m", "shape": {"type": "sphere", "radius": 0.1}}]})";
}

const char* const kFoam =
    R"("density": 100, "bulk_modulus": 1e5, "shear_modulus": 1e3, "yield_stress": 30, "viscosity": 10)";
std::string viscous(const std::string& law, double shear, double bulk) {
  return law + ", \"viscosity\": " + std::to_string(shear) + ", \"bulk_viscosity\": " + std::to_string(bulk);
}

Plan plan_of(const std::string& law, const std::vector<Override>& overrides = {}) {
  return make_plan(parse_scene(ball_of(law), "", overrides));
}

std::vector<std::string> fields_of(const std::string& law, const std::vector<Override>& overrides = {}) {
  std::vector<std::string> names;
  const Plan plan = plan_of(law, overrides);
  for (const PlannedField& f : plan.materials.at(0).fields) names.push_back(f.name);
  return names;
}

std::vector<std::string> with_places(const std::vector<std::string>& of_law) {
  std::vector<std::string> names = {"position in cell", "velocity"};
  names.insert(names.end(), of_law.begin(), of_law.end());
  names.insert(names.end(), {"id", "cell"});
  return names;
}

TEST(MlsrkPlan, AMaterialCarriesWhatItsLawKeepsAndNothingElse) {
  const std::string f = "deformation F - I";
  const std::string jp = "plastic volume change Jp - 1";
  EXPECT_EQ(fields_of(kFoam), with_places({"volume change J - 1", "elastic strain be - I"}));
  EXPECT_EQ(fields_of(kJelly), with_places({f}));
  EXPECT_EQ(fields_of(kSand), with_places({f, jp}));
  EXPECT_EQ(fields_of(kSnow), with_places({f, jp}));
  EXPECT_EQ(fields_of(kWater), with_places({"volume change J - 1"}));
}

TEST(MlsrkPlan, OnlyViscousMaterialsCarryAVelocityGradient) {
  const std::string gradient = "velocity gradient";
  EXPECT_EQ(fields_of(viscous(kWater, 1, 0)), with_places({"volume change J - 1", gradient}));
  EXPECT_EQ(fields_of(viscous(kJelly, 0, 1)), with_places({"deformation F - I", gradient}));
  EXPECT_EQ(fields_of(viscous(kSand, 1, 1)),
            with_places({"deformation F - I", "plastic volume change Jp - 1", gradient}));
}

TEST(MlsrkPlan, PlasticStrainIsCarriedByFoamWhereItIsAskedForAndElseWarnedOf) {
  const Override asked = {"/look/color_by", "plastic_strain"};
  EXPECT_EQ(fields_of(kFoam, {asked}),
            with_places({"volume change J - 1", "elastic strain be - I", "plastic strain"}));
  EXPECT_EQ(fields_of(kJelly, {asked}), with_places({"deformation F - I"}));
  EXPECT_EQ(plan_of(kJelly, {asked}).warnings.size(), plan_of(kJelly).warnings.size() + 1);
  EXPECT_EQ(plan_of(kFoam, {asked}).warnings.size(), plan_of(kFoam).warnings.size());
}

TEST(MlsrkPlan, HasTheStagesOfItsSolverAndCollisionsOnlyWhereThereIsContact) {
  EXPECT_EQ(plan_of(kWater).stages,
            (std::vector<std::string>{"sort", "neighbours", "shape functions", "stress", "momentum",
                                      "velocity gradients", "deformation", "positions"}));
  EXPECT_EQ(
      plan_of(kWater, {{"/domain/boundary", "slip"}}).stages,
      (std::vector<std::string>{"sort", "neighbours", "shape functions", "stress", "momentum",
                                "particle collisions", "velocity gradients", "deformation", "positions"}));
}

TEST(MlsrkPlan, OnlyMaterialsThatAGripCanTakeCarryAWordForIt) {
  const std::vector<Override> two = {
      {"/materials", "[{\"name\": \"m\", " + kJelly + "}, {\"name\": \"sand\", " + kSand + "}]"},
      {"/bodies", R"([{"name": "ball", "material": "m", "shape": {"type": "sphere", "radius": 0.1}},
                      {"name": "pile", "material": "sand",
                       "shape": {"type": "sphere", "radius": 0.1, "translate": [0.5, 0, 0]}}])"}};
  const auto plan_with = [&](const char* grips) {
    std::vector<Override> all = two;
    if (grips != nullptr) all.push_back({"/grips", grips});
    return plan_of(kJelly, all);
  };
  const auto grip_bytes = [](const PlannedMaterial& m) {
    for (const PlannedField& f : m.fields)
      if (f.name == "grip") return f.bytes;
    return 0;
  };
  const Plan none = plan_with(nullptr);
  const Plan one = plan_with(R"([{"name": "hand", "body": "pile"}])");
  const Plan both = plan_with(R"([{"name": "hand", "shape": {"type": "sphere", "radius": 0.05}}])");
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(grip_bytes(none.materials[m]), 0);
    EXPECT_EQ(grip_bytes(one.materials[m]), m == 1 ? 4 : 0);
    EXPECT_EQ(grip_bytes(both.materials[m]), 4);
  }
  EXPECT_EQ(one.materials[0].bytes_per_point, none.materials[0].bytes_per_point);
  EXPECT_EQ(one.stages.size(), none.stages.size() + 1) << "grips act among the collisions";
}

TEST(MlsrkPlan, SamplesOnePointASpacing) {
  // A ball of 0.1 m at 10 mm; its surface cuts about 1300 places.
  EXPECT_NEAR(static_cast<double>(plan_of(kWater).points), 4.0 / 3.0 * M_PI * 1e3, 40);
}

TEST(MlsrkPlan, WaveSpeedIsThatOfTheLaw) {
  const auto speed = [](const std::string& law) { return plan_of(law).materials.at(0).wave_speed; };
  EXPECT_NEAR(speed(kFoam), std::sqrt((1e5 + 4.0 / 3.0 * 1e3) / 100), 1e-9);
  // E (1 - nu) / ((1 + nu) (1 - 2 nu)) is lambda + 2 mu.
  EXPECT_NEAR(speed(kJelly), std::sqrt(5e3 * 0.6 / (1.4 * 0.2) / 1000), 1e-9);
  EXPECT_NEAR(speed(kSand), std::sqrt(1e6 * 0.7 / (1.3 * 0.4) / 1600), 1e-9);
  EXPECT_NEAR(speed(kSnow), std::sqrt(1.4e5 * 0.8 / (1.2 * 0.6) / 400), 1e-9);
  EXPECT_NEAR(speed(kWater), 10, 1e-12);
}

TEST(MlsrkPlan, StepBoundIsTheShorterOfWavesAndViscosity) {
  EXPECT_NEAR(plan_of(kWater).step_bound, 0.01 / 10, 1e-15);
  // In 3D (4/3 mu_v + zeta_v + mu_v) / rho; d^2 / (2 nu) is shorter than the wave's 1e-3 s from nu = 0.05 on.
  const double diffusion = (4.0 / 3.0 * 30 + 20 + 30) / 1000;
  EXPECT_NEAR(plan_of(viscous(kWater, 30, 20)).step_bound, 1e-4 / (2 * diffusion), 1e-15);
  EXPECT_NEAR(plan_of(viscous(kWater, 3, 2)).step_bound, 0.01 / 10, 1e-15);
  // In 2D mu_v + zeta_v along the change and mu_v across.
  EXPECT_NEAR(plan_of(viscous(kWater, 30, 20), {{"/dimension", "2"}}).step_bound, 1e-4 / (2 * 0.08), 1e-15);
}

TEST(MlsrkPlan, StepBoundIsThatOfTheMaterialWhichAllowsLeast) {
  const std::string two = "[{\"name\": \"m\", " + kWater + "}, {\"name\": \"stiff\", " + kSand + "}]";
  const Override materials = {"/materials", two};
  EXPECT_NEAR(plan_of(kWater, {materials}).step_bound, 0.01 / 10, 1e-15);  // no body is stiff
  const double stiff = plan_of(kSand).step_bound;
  ASSERT_LT(stiff, 0.01 / 10);
  const Override body = {"/bodies/0/material", "stiff"};
  EXPECT_DOUBLE_EQ(plan_of(kWater, {materials, body}).step_bound, stiff);
}

TEST(MlsrkPlan, TheBlendsViscosityFollowsItsFormulaAndWarnsWhenItOutweighsTheLiquids) {
  // rho (1 - alpha_b) a^2 / (6 dt) with a = 1.5 spacings: 18.75 Pa s at the reference step of 1e-4 s.
  const Scene s = parse_scene(ball_of(kWater));
  EXPECT_NEAR(velocity_blend_viscosity(s, 1000, 1e-4), 1000 * 0.05 * 0.015 * 0.015 / (6 * 1e-4), 1e-9);
  // Per time: half the step keeps the viscosity (to the first order of 1 - alpha_b).
  EXPECT_NEAR(velocity_blend_viscosity(s, 1, 5e-5) / velocity_blend_viscosity(s, 1, 1e-4), 1, 0.02);
  const Plan thin = plan_of(viscous(kWater, 1, 0));
  EXPECT_DOUBLE_EQ(thin.materials.at(0).numerical_viscosity,
                   velocity_blend_viscosity(thin.scene, 1000, thin.time_step));
  ASSERT_EQ(thin.warnings.size(), 1U);
  EXPECT_NE(thin.warnings[0].find("velocity_blend"), std::string::npos);
  EXPECT_TRUE(plan_of(viscous(kWater, 100, 0)).warnings.empty());
  const Override none = {"/numerics/mlsrk/velocity_blend", "1"};
  EXPECT_EQ(plan_of(viscous(kWater, 1, 0), {none}).materials.at(0).numerical_viscosity, 0);
}

TEST(MlsrkPlan, WarnsOfAFixedStepBeyondItsBound) {
  EXPECT_TRUE(plan_of(kWater, {{"/numerics/time_step", "9e-4"}}).warnings.empty());
  const Plan long_step = plan_of(kWater, {{"/numerics/time_step", "2e-3"}});
  ASSERT_EQ(long_step.warnings.size(), 1U);
  EXPECT_NE(long_step.warnings[0].find("longer than waves and viscosity allow"), std::string::npos);
}

TEST(MlsrkPlan, ItsMemoryGrowsWithTheBasisAndTheReals) {
  const auto bytes = [](const std::vector<Override>& overrides) {
    return plan_of(kWater, overrides).memory_bytes;
  };
  const std::uint64_t linear = bytes({});
  EXPECT_LT(bytes({{"/numerics/mlsrk/basis", "constant"}}), linear);
  EXPECT_GT(bytes({{"/numerics/mlsrk/basis", "quadratic"}}), linear);
  EXPECT_GT(bytes({{"/numerics/precision", "double"}}), linear);
}

TEST(MlsrkPlan, SurvivesTheWayThroughJson) {
  const Plan p = plan_of(viscous(kSand, 1, 2));
  EXPECT_EQ(to_json(read_plan(to_json(p))), to_json(p));
}

}  // namespace
}  // namespace lather
