// What holds of every example scene.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, CanBePlannedAsItStands) {
  const Plan plan = make_plan(scene_file(GetParam(), ""));
  EXPECT_GT(plan.scene.last_frame(), 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace lather::testing_support
