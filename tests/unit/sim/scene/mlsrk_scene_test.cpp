#include <gtest/gtest.h>

#include <array>

#include "sim/scene/value.h"
#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

TEST(Material, HoldsTheParametersOfItsModel) {
  const Scene s = parse_scene(mlsrk_scene());
  const auto& jelly = std::get<NeoHookeanParameters>(s.materials[1].law);
  EXPECT_EQ(jelly.elastic.density, 1000);
  EXPECT_EQ(jelly.elastic.youngs_modulus, 5e3);
  EXPECT_EQ(jelly.elastic.poisson_ratio, 0.4);
  EXPECT_EQ(jelly.viscous.viscosity, 0.5);
  EXPECT_EQ(jelly.viscous.bulk_viscosity, 0.25);
  const auto& sand = std::get<DruckerPragerParameters>(s.materials[2].law);
  EXPECT_EQ(sand.elastic.youngs_modulus, 1e6);
  EXPECT_EQ(sand.viscous.bulk_viscosity, 3);
  EXPECT_EQ(sand.friction_angle_deg, 30);
  EXPECT_EQ(sand.match, FrictionMatch::kPlaneStrain);
  EXPECT_EQ(sand.cohesion, 0.01);
  EXPECT_EQ(sand.hardening, 5);
  const auto& snow = std::get<SnowParameters>(s.materials[3].law);
  EXPECT_EQ(snow.elastic.density, 400);
  EXPECT_EQ(snow.critical_compression, 0.019);
  EXPECT_EQ(snow.critical_stretch, 0.005);
  EXPECT_EQ(snow.hardening, 7);
  const auto& water = std::get<LiquidParameters>(s.materials[4].law);
  EXPECT_EQ(water.density, 1000);
  EXPECT_EQ(water.bulk_modulus, 1e5);
  EXPECT_EQ(water.exponent, 3);
  EXPECT_EQ(water.viscous.viscosity, 0.1);
  EXPECT_EQ(water.viscous.bulk_viscosity, 0.2);
  const std::array<double, 5> densities = {100, 1000, 1600, 400, 1000};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(s.materials.at(i).density(), densities[i]);
}

TEST(Material, OfEveryModelIsWrittenAsItWasRead) {
  const std::string once = to_json(parse_scene(mlsrk_scene()));
  EXPECT_EQ(to_json(parse_scene(once)), once);
  const Value written = parse_json(once);
  const Value given = parse_json(mlsrk_scene());
  for (std::size_t i = 0; i < 5; ++i) {
    const Value& out = (*written.find("materials")->array())[i];
    for (const auto& [key, value] : *(*given.find("materials")->array())[i].object()) {
      ASSERT_NE(out.find(key), nullptr) << key;
      const auto* number = std::get_if<double>(&value.data);
      if (number != nullptr) {
        EXPECT_EQ(std::get<double>(out.find(key)->data), *number) << key;
      }
    }
    EXPECT_EQ(out.find("tear_threshold") != nullptr, i == 0) << "tearing goes with herschel-bulkley";
  }
}

TEST(MlsrkScene, SamplesOnePointASpacing) {
  const Scene s = parse_scene(mlsrk_scene());
  EXPECT_EQ(s.points_per_cell, 1);
  EXPECT_DOUBLE_EQ(s.point_volume(), 0.05 * 0.05 * 0.05);
}

TEST(MlsrkScene, KeepsEveryKeyOfItsNumerics) {
  const Scene s = parse_scene(mlsrk_scene(
      {{"/numerics",
        R"({"mlsrk": {"basis": "quadratic", "kernel_shape": "radial", "support_radius": 2.5, "regularization": 0.1,
      "regularize_constant": true, "velocity_blend": 0.5, "velocity_blend_reference_step": 1e-3,
      "inertial_mass": "own", "volume_correction": false}})"}}));
  const Mlsrk& m = s.numerics.mlsrk;
  EXPECT_EQ(m.basis, Basis::kQuadratic);
  EXPECT_EQ(m.kernel_shape, KernelShape::kRadial);
  EXPECT_EQ(m.support_radius, 2.5);
  EXPECT_EQ(m.regularization, 0.1);
  EXPECT_TRUE(m.regularize_constant);
  EXPECT_EQ(m.velocity_blend, 0.5);
  EXPECT_EQ(m.velocity_blend_reference_step, 1e-3);
  EXPECT_EQ(m.inertial_mass, InertialMass::kOwn);
  EXPECT_FALSE(m.volume_correction);
  const std::string once = to_json(s);
  EXPECT_EQ(to_json(parse_scene(once)), once);
  EXPECT_NE(once.find("\"quadratic\""), std::string::npos);
}

TEST(MlsrkScene, ItsNumericsDoNotTellMpmScenesApart) {
  const Scene plain = parse_scene(small_scene());
  EXPECT_EQ(to_json(plain).find("mlsrk"), std::string::npos);
  const Scene with_numerics = parse_scene(with("/numerics", R"({"mlsrk": {"support_radius": 2}})"));
  EXPECT_EQ(scene_hash(plain), scene_hash(with_numerics));
}

TEST(MlsrkScene, MayBeJitteredPeriodicAndShownWithASkin) {
  EXPECT_TRUE(problems_of(mlsrk_scene({{"/jitter", "0.5"},
                                       {"/look/style", "\"skin\""},
                                       {"/domain/periodic", "[true, false, false]"},
                                       {"/domain/max/0", "0.4"}}))
                  .empty());
}

/// Changes of a good scene, and what must be said about it.
struct Wrong {
  Changes changes;
  std::string pointer;  ///< where the problem is
  std::string allowed;  ///< part of what is allowed
  std::string says;     ///< part of the message
};

void PrintTo(const Wrong& w, std::ostream* out) {
  *out << w.pointer;
}

class MlsrkSceneError : public testing::TestWithParam<Wrong> {};

TEST_P(MlsrkSceneError, HasItsPointerWhatIsAllowedAndWhatToDo) {
  const Wrong& w = GetParam();
  const std::vector<Problem> problems = problems_of(mlsrk_scene(w.changes));
  ASSERT_EQ(problems.size(), 1U) << (problems.empty() ? "accepted" : InputError(problems).what());
  EXPECT_EQ(problems[0].pointer, w.pointer);
  EXPECT_NE(problems[0].allowed.find(w.allowed), std::string::npos) << problems[0].allowed;
  EXPECT_NE(problems[0].message.find(w.says), std::string::npos) << problems[0].message;
}

INSTANTIATE_TEST_SUITE_P(
    OfTheSolver, MlsrkSceneError,
    testing::Values(
        Wrong{{{"/points_per_cell", "8"}}, "/points_per_cell", "1 with", "Take \"points_per_cell\" out"},
        Wrong{{{"/numerics/integration", "\"semi-implicit\""}},
              "/numerics/integration",
              "\"explicit\"",
              "set \"solver\" to \"mpm\""},
        Wrong{
            {{"/numerics/resampling", "{}"}}, "/numerics/resampling", "left out", "Take \"resampling\" out"},
        Wrong{{{"/numerics/subgrid_removal", "{}"}}, "/numerics/subgrid_removal", "left out", "has no grid"},
        Wrong{{{"/materials/0/tear_threshold", "2"}},
              "/materials/0/tear_threshold",
              "\"infinity\"",
              "Set \"tear_threshold\" to \"infinity\""},
        Wrong{{{"/materials/0", R"({"name": "foam", "preset": "pie"})"}},
              "/materials/0/tear_threshold",
              "\"infinity\"",
              "the preset gives a threshold"},
        Wrong{{{"/emitters",
                R"([{"name": "e", "material": "foam", "shape": {"type": "sphere", "radius": 0.1}}])"}},
              "/emitters",
              "left out",
              "set \"solver\" to \"mpm\""},
        Wrong{{{"/probes", R"([{"type": "walls", "name": "w"}])"}}, "/probes", "left out", "takes no probes"},
        Wrong{{{"/domain/max/1", "0.2"}, {"/domain/periodic", "[false, true, false]"}},
              "/domain/periodic/1",
              "at least 8 spacings, 0.4 m",
              "Widen the domain along y"},
        Wrong{{{"/numerics/mlsrk", R"({"support_radius": 5})"}},
              "/numerics/mlsrk/support_radius",
              "from 1.5 to 4 spacings",
              "out of range"},
        Wrong{{{"/numerics/mlsrk", R"({"radius": 3})"}},
              "/numerics/mlsrk/radius",
              "support_radius",
              "not known"}));

INSTANTIATE_TEST_SUITE_P(
    OfItsMaterials, MlsrkSceneError,
    testing::Values(
        Wrong{{{"/materials/1/yield_stress", "3"}},
              "/materials/1/yield_stress",
              "\"youngs_modulus\"",
              "goes with the model \"herschel-bulkley\"; this material is of the model \"neo-hookean\""},
        Wrong{{{"/materials/4/youngs_modulus", "3"}},
              "/materials/4/youngs_modulus",
              "\"exponent\"",
              "\"neo-hookean\", \"drucker-prager\" or \"snow\""},
        Wrong{{{"/materials/3/viscosity", "3"}}, "/materials/3/viscosity", "\"hardening\"", "\"snow\""},
        Wrong{{{"/materials/3/tear_threshold", "3"}},
              "/materials/3/tear_threshold",
              "\"hardening\"",
              "goes with the model \"herschel-bulkley\""},
        Wrong{{{"/materials/3/preset", "\"pie\""}},
              "/materials/3/preset",
              "\"hardening\"",
              "goes with the model \"herschel-bulkley\""},
        Wrong{{{"/materials/2/frictoin_match", "\"plane-strain\""}},
              "/materials/2/frictoin_match",
              "\"friction_match\"",
              "Did you mean \"friction_match\"?"},
        Wrong{{{"/materials/2/friction_match", "\"plane\""}},
              "/materials/2/friction_match",
              "\"triaxial-compression\" or \"plane-strain\"",
              "not known"},
        Wrong{{{"/materials/1/poisson_ratio", "0.5"}},
              "/materials/1/poisson_ratio",
              "from 0 to 0.4999",
              "out of range"},
        Wrong{{{"/materials/1/youngs_modulus", "null"}},
              "/materials/1/youngs_modulus",
              "Pa",
              "\"youngs_modulus\" is missing"},
        Wrong{{{"/materials/2/friction_angle_deg", "90"}},
              "/materials/2/friction_angle_deg",
              "from 0 to 89 degrees",
              "out of range"},
        Wrong{{{"/materials/3/critical_compression", "1"}},
              "/materials/3/critical_compression",
              "from 0 to 1 (not itself)",
              "out of range"},
        Wrong{{{"/materials/4/exponent", "0.5"}}, "/materials/4/exponent", "from 1", "out of range"},
        Wrong{{{"/materials/4/model", "\"likwid\""}},
              "/materials/4/model",
              "\"herschel-bulkley\", \"neo-hookean\", \"drucker-prager\", \"snow\" or \"liquid\"",
              "Did you mean \"liquid\"?"},
        Wrong{
            {{"/materials/4/model", "7"}}, "/materials/4/model", "\"liquid\"", "must be one of the names"}));

TEST(MpmScene, TakesEveryModelSoThatASceneChangesItsSolverByOneWord) {
  EXPECT_TRUE(problems_of(mlsrk_scene({{"/solver", "\"mpm\""}})).empty());
}

TEST(MpmScene, RefusesBesideOtherModelsWhatItCanDoWithFoamAlone) {
  const std::vector<std::pair<std::string, std::string>> foam_only = {{"integration", "\"semi-implicit\""},
                                                                      {"resampling", "{}"}};
  for (const auto& [key, json] : foam_only) {
    const std::string pointer = "/numerics/" + key;
    const std::vector<Problem> problems = problems_of(mlsrk_scene({{"/solver", "\"mpm\""}, {pointer, json}}));
    ASSERT_EQ(problems.size(), 1U) << key;
    EXPECT_EQ(problems[0].pointer, pointer);
    EXPECT_NE(problems[0].allowed.find("beside other models"), std::string::npos) << problems[0].allowed;
    EXPECT_NE(problems[0].message.find("\"jelly\" is of the model \"neo-hookean\""), std::string::npos)
        << problems[0].message;
    EXPECT_TRUE(problems_of(with(pointer, json)).empty()) << "foam alone";
  }
}

/// Material 2 of mlsrk_scene(), sand, with a phase whose parameters change as given.
std::vector<Problem> problems_with_curves(const std::string& curves, const Changes& more = {}) {
  Changes changes = {{"/materials/2/phase",
                      R"({"concentration": 0.5, "mobility": 1e-6, "by_concentration": {)" + curves + "}}"}};
  changes.insert(changes.end(), more.begin(), more.end());
  return problems_of(mlsrk_scene(changes));
}

TEST(PhaseOfAMaterial, GivesTheLawOfItsConcentrationAndIsWrittenAsItWasRead) {
  const std::string text = mlsrk_scene({{"/materials/2/cohesion", "null"},
                                        {"/materials/2/phase",
                                         R"({"concentration": 0.5, "mobility": 1e-6, "by_concentration": {
            "cohesion": {"type": "table", "points": [[0.25, 0.01], [0.75, 0.03]]}}})"}});
  const Scene s = parse_scene(text);
  EXPECT_DOUBLE_EQ(std::get<DruckerPragerParameters>(s.materials[2].law).cohesion, 0.02);
  const std::vector<Law> laws = s.materials[2].laws();
  ASSERT_EQ(laws.size(), kConcentrationNodes + 1U);
  EXPECT_DOUBLE_EQ(std::get<DruckerPragerParameters>(laws.front()).cohesion, 0.01);
  EXPECT_DOUBLE_EQ(std::get<DruckerPragerParameters>(laws.back()).cohesion, 0.03);
  const std::string once = to_json(s);
  EXPECT_EQ(to_json(parse_scene(once)), once);
  EXPECT_EQ(s.materials[1].laws().size(), 1U);
}

TEST(PhaseOfAMaterial, IsRefusedWhereItIsWrong) {
  const std::string step = R"({"type": "smoothstep", "from": 0.2, "to": 0.4, "start": 1, "end": 2})";
  const std::string here = "/materials/2/phase/by_concentration";
  const auto expect = [](const std::vector<Problem>& problems, const std::string& pointer) {
    ASSERT_FALSE(problems.empty()) << pointer;
    EXPECT_EQ(problems.front().pointer, pointer);
  };
  expect(problems_with_curves("\"viscositty\": " + step), here + "/viscositty");
  expect(problems_with_curves("\"cohesion\": " + step), "/materials/2/cohesion");
  expect(problems_with_curves(R"("cohesion": {"type": "polynomial", "coefficients": [1, -2]})",
                              {{"/materials/2/cohesion", "null"}}),
         here + "/cohesion");
  expect(problems_with_curves(
             R"("viscosity": {"type": "smoothstep", "from": 0.4, "to": 0.2, "start": 1, "end": 2})",
             {{"/materials/2/viscosity", "null"}}),
         here + "/viscosity/to");
  expect(problems_with_curves(R"("viscosity": {"type": "table", "points": [[0.4, 1], [0.4, 2]]})",
                              {{"/materials/2/viscosity", "null"}}),
         here + "/viscosity/points/1/0");
}

TEST(PhaseOfAMaterial, IsRefusedByTheGridSolver) {
  const auto problems = problems_of(with("/materials/0/phase", R"({"concentration": 0, "mobility": 0})"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().pointer, "/materials/0/phase");
}

}  // namespace
}  // namespace lather::test
