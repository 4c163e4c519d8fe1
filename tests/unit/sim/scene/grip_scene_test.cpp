// Grips and mixtures in scenes: read, written, refused.

#include <gtest/gtest.h>

#include "sim/plan/plan.h"
#include "sim/scene/value.h"
#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

/// The problem that the scene with these changes has, which must be the only one.
Problem problem_of(const Changes& changes) {
  const std::vector<Problem> problems = problems_of(mlsrk_scene(changes));
  EXPECT_EQ(problems.size(), 1U);
  return problems.empty() ? Problem{} : problems.front();
}

TEST(Grips, AreWrittenAsTheyWereReadAndLeftOutWhereThereAreNone) {
  const std::string text =
      mlsrk_scene({{"/grips", R"([{"name": "hand", "body": "ball", "start": 0.25, "end": 0.5,
                       "motion": {"type": "linear", "velocity": [1, 2, 3]}},
                      {"name": "floor", "shape": {"type": "plane", "translate": [0, 0.4, 0]}}])"}});
  const Scene scene = parse_scene(text);
  ASSERT_EQ(scene.grips.size(), 2U);
  EXPECT_EQ(scene.grips[0].body, "ball");
  EXPECT_EQ(scene.grips[0].shape, nullptr);
  EXPECT_EQ(scene.grips[0].start, 0.25);
  EXPECT_EQ(scene.grips[0].end, 0.5);
  EXPECT_EQ(std::get<LinearMotion>(scene.grips[0].motion).velocity, Vec3(1, 2, 3));
  EXPECT_EQ(scene.grips[1].body, "");
  ASSERT_NE(scene.grips[1].shape, nullptr);
  const std::string once = to_json(scene);
  EXPECT_EQ(to_json(parse_scene(once)), once);
  EXPECT_EQ(parse_json(to_json(parse_scene(mlsrk_scene()))).find("grips"), nullptr);
}

TEST(Grips, ThatNameNothingKnownOrNothingAtAllAreRefused) {
  Problem p = problem_of({{"/grips", R"([{"name": "hand", "body": "bal"}])"}});
  EXPECT_EQ(p.pointer, "/grips/0/body");
  EXPECT_NE(p.message.find("Did you mean \"ball\"?"), std::string::npos);
  p = problem_of({{"/grips", R"([{"name": "hand"}])"}});
  EXPECT_EQ(p.pointer, "/grips/0/body");
  p = problem_of({{"/grips", R"([{"name": "hand", "body": "ball", "start": 1, "end": 0.5}])"}});
  EXPECT_EQ(p.pointer, "/grips/0/end");
  p = problem_of({{"/grips", R"([{"name": "hand", "body": "ball"}, {"name": "hand", "body": "ball"}])"}});
  EXPECT_EQ(p.pointer, "/grips/1/name");
}

TEST(Grips, OfTheGridSolverAreRefused) {
  const std::vector<Problem> problems = problems_of(with("/grips", R"([{"name": "hand", "body": "ball"}])"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/grips");
  EXPECT_NE(problems[0].message.find("adhesive obstacle"), std::string::npos);
}

TEST(Grips, ThatLeadOutOfA2DPlaneAreRefused) {
  const Changes flat = {{"/dimension", "2"}};
  for (const char* motion :
       {R"({"type": "rotation", "rate_deg": 90})", R"({"type": "linear", "velocity": [0, 0, 1]})",
        R"({"type": "oscillation", "direction": [0, 0, 1], "amplitude": 1, "frequency": 1})",
        R"({"type": "keyframes", "keys": [{"time": 0}, {"time": 1, "rotate_deg": [9, 0, 0]}]})"}) {
    Changes changes = flat;
    changes.emplace_back("/grips",
                         std::string(R"([{"name": "hand", "body": "ball", "motion": )") + motion + "}]");
    EXPECT_EQ(problem_of(changes).pointer, "/grips/0/motion") << motion;
  }
  const Changes turning = {flat[0], {"/grips", R"([{"name": "hand", "body": "ball", "motion":
                                           {"type": "rotation", "axis": [0, 0, 1], "rate_deg": 90}}])"}};
  EXPECT_TRUE(problems_of(mlsrk_scene(turning)).empty());
}

TEST(Grips, ThatTakeNoPointAreRefusedByThePlan) {
  const auto pointer = [](const std::string& grips) -> std::string {
    try {
      (void)make_plan(parse_scene(mlsrk_scene({{"/grips", grips}})));
    } catch (const InputError& error) {
      return error.problems().front().pointer;
    }
    return "";
  };
  EXPECT_EQ(
      pointer(
          R"([{"name": "far", "shape": {"type": "sphere", "radius": 0.1, "translate": [0.1, 0.1, 0.1]}}])"),
      "/grips/0");
  EXPECT_EQ(pointer(R"([{"name": "all", "body": "ball"},
                        {"name": "late", "shape": {"type": "plane", "translate": [0, 0.5, 0]}}])"),
            "/grips/1");
  EXPECT_EQ(pointer(R"([{"name": "half", "shape": {"type": "plane", "translate": [0, 0.5, 0]}},
                        {"name": "rest", "body": "ball"}])"),
            "");
}

TEST(Mixture, IsWrittenAsItWasRead) {
  Value scene = parse_json(mlsrk_scene());
  set_at_pointer(scene, "/bodies", parse_json(R"([{"name": "ball", "shape": {"type": "sphere", "radius": 0.2},
    "mixture": [{"material": "sand", "share": 2}, {"material": "water"}]}])"));
  const Scene read = parse_scene(write_json(scene));
  EXPECT_EQ(read.bodies[0].material_names(), (std::vector<std::string>{"sand", "water"}));
  EXPECT_EQ(read.bodies[0].mixture[0].share, 2);
  EXPECT_EQ(read.bodies[0].mixture[1].share, 1);
  const std::string once = to_json(read);
  EXPECT_EQ(to_json(parse_scene(once)), once);
  EXPECT_EQ((*parse_json(once).find("bodies")->array())[0].find("material"), nullptr);
}

TEST(Mixture, BesideAMaterialOrWithoutAnyIsRefused) {
  Problem p = problem_of({{"/bodies/0/mixture", R"([{"material": "sand"}])"}});
  EXPECT_EQ(p.pointer, "/bodies/0/material");
  p = problem_of({{"/bodies", R"([{"name": "ball", "shape": {"type": "sphere", "radius": 0.2}}])"}});
  EXPECT_EQ(p.pointer, "/bodies/0/material");
  EXPECT_NE(p.message.find("mixture"), std::string::npos);
  p = problem_of({{"/bodies", R"([{"name": "ball", "shape": {"type": "sphere", "radius": 0.2},
                                   "mixture": [{"material": "sad"}]}])"}});
  EXPECT_EQ(p.pointer, "/bodies/0/mixture/0/material");
  EXPECT_NE(p.message.find("\"sand\""), std::string::npos);
  p = problem_of({{"/bodies", R"([{"name": "ball", "shape": {"type": "sphere", "radius": 0.2},
                                   "mixture": [{"material": "sand", "share": 0}]}])"}});
  EXPECT_EQ(p.pointer, "/bodies/0/mixture/0/share");
}

}  // namespace
}  // namespace lather::test
