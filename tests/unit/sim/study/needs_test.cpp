// Only what a scene needs: a feature whose parameters are absent has no field and no stage.

#include "sim/study/needs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/feature_scenes.h"

namespace lather::testing_support {

/// For GoogleTest, which would print the scene's bytes.
inline void PrintTo(const FeatureScene& feature, std::ostream* out) {
  *out << feature.name;
}

}  // namespace lather::testing_support

namespace lather::study {
namespace {

using testing_support::feature_scenes;
using testing_support::FeatureScene;

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> fields_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlannedField& f : plan.materials.at(0).fields) names.push_back(f.name);
  return names;
}

/// The stages that the trial spent time in.
std::vector<std::string> ran(const Plan& plan) {
  std::vector<std::string> names;
  const SceneNeeds needs = needs_of(plan, 1, 60);
  for (const StageNeed& s : needs.stages)
    if (s.share.value_or(0) > 0) names.push_back(s.name);
  names.insert(names.end(), needs.idle.begin(), needs.idle.end());
  return names;
}

class Feature : public testing::TestWithParam<FeatureScene> {};

TEST_P(Feature, HasItsFieldsAndStages) {
  const Plan plan = make_plan(scene_with(GetParam()));
  for (const std::string& field : GetParam().fields) EXPECT_TRUE(holds(fields_of(plan), field)) << field;
  for (const std::string& stage : GetParam().stages) EXPECT_TRUE(holds(plan.stages, stage)) << stage;
  EXPECT_NE(to_json(scene_with(GetParam())), to_json(minimal_scene(GetParam())));
}

TEST_P(Feature, LeavesNothingBehindWhereItIsAbsent) {
  const Plan minimal = make_plan(minimal_scene(GetParam()));
  const Plan absent = make_plan(scene_without(GetParam()));
  EXPECT_EQ(fields_of(absent), fields_of(minimal));
  EXPECT_EQ(absent.materials.at(0).bytes_per_point, minimal.materials.at(0).bytes_per_point);
  EXPECT_EQ(absent.memory_bytes, minimal.memory_bytes);
  EXPECT_EQ(absent.stages, minimal.stages);
  EXPECT_EQ(absent.steps, minimal.steps);
  for (const std::string& field : GetParam().fields) EXPECT_FALSE(holds(fields_of(absent), field)) << field;
  for (const std::string& stage : GetParam().stages) EXPECT_FALSE(holds(absent.stages, stage)) << stage;
}

TEST_P(Feature, RunsTheStagesOfItsPlanAndNoOthers) {
  for (const Scene& scene : {scene_with(GetParam()), scene_without(GetParam())}) {
    const Plan plan = make_plan(scene);
    EXPECT_EQ(needs_of(plan, 1, 60).idle, std::vector<std::string>{});
  }
  const std::vector<std::string> run = ran(make_plan(scene_without(GetParam())));
  for (const std::string& stage : GetParam().stages) EXPECT_FALSE(holds(run, stage)) << stage;
}

INSTANTIATE_TEST_SUITE_P(Needs, Feature, testing::ValuesIn(feature_scenes()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(Needs, SharesOfAllTimedStagesAddUp) {
  const Plan plan = make_plan(minimal_scene(feature_scenes().front()));
  double all = 0;
  for (const StageNeed& s : needs_of(plan, 1, 0.05).stages) all += s.share.value_or(0);
  EXPECT_NEAR(all, 1, 1e-12);
}

}  // namespace
}  // namespace lather::study
