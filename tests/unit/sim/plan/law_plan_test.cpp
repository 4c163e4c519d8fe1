// Plans of the grid solver with other laws than foam's: what the other solver's points carry, its own steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/plan/plan.h"
#include "tests/support/law_scenes.h"

namespace lather {
namespace {

using testing_support::kJelly;
using testing_support::kSand;
using testing_support::kSnow;
using testing_support::kWater;

/// A ball of one material on a grid of 10 mm in free space; `law` are the material's keys.
Plan plan_of(const std::string& law, const std::vector<Override>& overrides = {}) {
  return make_plan(
      parse_scene(R"({"lather": 1, "domain": {"min": [-1, -1, -1], "max": [1, 1, 1], "boundary": "open"},
    "duration": 0.1, "frame_rate": 10, "spacing": 0.01, "numerics": {"transfer": "apic"},
    "materials": [{"name": "m", )" +
                      law + R"(}],
    "bodies": [{"name": "ball", "material": "m", "shape": {"type": "sphere", "radius": 0.05}}]})",
                  "", overrides));
}

std::vector<std::string> fields_of(const std::string& law, const std::vector<Override>& overrides = {}) {
  std::vector<std::string> names;
  const Plan plan = plan_of(law, overrides);
  for (const PlannedField& f : plan.materials.at(0).fields) names.push_back(f.name);
  return names;
}

TEST(LawPlan, AMaterialCarriesWhatItsLawKeepsAndNothingElse) {
  const auto with = [](std::vector<std::string> law) {
    std::vector<std::string> names = {"position in cell", "velocity"};
    names.insert(names.end(), law.begin(), law.end());
    names.insert(names.end(), {"id", "cell", "affine velocity C"});
    return names;
  };
  const std::string viscous = R"(, "viscosity": 1)";
  const std::string f = "deformation F - I";
  const std::string jp = "plastic volume change Jp - 1";
  const std::string j = "volume change J - 1";
  const std::string gradient = "velocity gradient";
  EXPECT_EQ(fields_of(kJelly), with({f}));
  EXPECT_EQ(fields_of(kSand), with({f, jp}));
  EXPECT_EQ(fields_of(kSnow), with({f, jp}));
  EXPECT_EQ(fields_of(kWater), with({j}));
  EXPECT_EQ(fields_of(kWater + viscous), with({j, gradient}));
  EXPECT_EQ(fields_of(kJelly + viscous), with({f, gradient}));
}

TEST(LawPlan, TheStepIsBoundByWavesAndViscosity) {
  EXPECT_NEAR(plan_of(kWater).step_bound, 0.01 / 10, 1e-15);
  // In 3D (4/3 mu_v + mu_v) / rho of diffusion, h^2 over twice of it.
  EXPECT_NEAR(plan_of(kWater + R"(, "viscosity": 30)").step_bound, 1e-4 / (2 * 0.07), 1e-15);
}

TEST(LawPlan, SaysThatVolumesOfLiquidsAndGrainsAreNotCorrected) {
  const auto says = [](const std::string& law, const std::vector<Override>& overrides = {}) {
    const std::vector<std::string> warnings = plan_of(law, overrides).warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& w) { return w.find("Volumes of \"m\"") != std::string::npos; });
  };
  EXPECT_TRUE(says(kWater));
  EXPECT_TRUE(says(kSand));
  EXPECT_FALSE(says(kSand + R"(, "cohesion": 0.01)"));  // keeps that of its deformation on both solvers
  EXPECT_FALSE(says(kSnow));
  EXPECT_FALSE(says(kJelly));
  EXPECT_FALSE(says(R"("preset": "shaving-cream")"));
  EXPECT_FALSE(says(kWater, {{"/solver", "\"mlsrk\""}}));
}

}  // namespace
}  // namespace lather
