#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/scene/material_cards.h"
#include "sim/scene/value.h"
#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

TEST(Scene, TakesDefaultsForWhatIsNotGiven) {
  const Scene s = parse_scene(small_scene());
  EXPECT_EQ(s.dimension, 3);
  EXPECT_EQ(s.points_per_cell, 8);
  EXPECT_EQ(s.frame_rate, 30);
  EXPECT_EQ(s.gravity, Vec3(0, -9.81, 0));
  EXPECT_EQ(s.numerics.kernel, Kernel::kCubic);
  EXPECT_TRUE(s.look.camera.automatic);
  EXPECT_TRUE(std::holds_alternative<AtRest>(s.obstacles[0].motion));
  EXPECT_EQ(s.last_frame(), 30);
}

TEST(Scene, LastFrameIsTheLastOneWithinTheDuration) {
  Scene s;
  s.frame_rate = 30;
  s.duration = 0.1;  // 0.1 * 30 is a little above 3 in binary
  EXPECT_EQ(s.last_frame(), 3);
  s.duration = 2.999 / 30;
  EXPECT_EQ(s.last_frame(), 2);
  s.frame_rate = 10;
  s.duration = 0.3;
  EXPECT_EQ(s.last_frame(), 3);
}

// Table I of "Continuum Foam", kPa turned into Pa.
TEST(MaterialCards, HoldThePrintedNumbers) {
  const std::vector<std::pair<std::string, std::array<double, 8>>> table = {
      {"shaving-cream", {77.7, 109000, 290, 31.9, 27.2, 0.22, 217.5, 0.35}},
      {"smore-interior", {50, 109000, 80, 10, 16, 0.43, 15, 0.25}},
      {"smore-exterior", {50, 109000, 50000, 1000, 0.1, 1, 0.3, 0.5}},
      {"pie", {275, 109000, 1600, 120, 5, 0.27, 10, 0.3}},
      {"oobleck", {1000, 109000, 11200, 0.1, 10, 2.8, 1, 0.3}},
      {"viscoplastic", {1000, 109000, 11200, 0.1, 10, 1, 1, 0.3}}};
  EXPECT_EQ(all_material_cards().size(), table.size());
  for (const auto& [name, numbers] : table) {
    const Scene s = parse_scene(with("/materials/0/preset", "\"" + name + "\""));
    const HerschelBulkleyParameters& p = s.materials[0].herschel_bulkley();
    EXPECT_EQ(s.materials[0].preset, name);
    EXPECT_DOUBLE_EQ(p.density, numbers[0]) << name;
    EXPECT_DOUBLE_EQ(p.bulk_modulus, numbers[1]) << name;
    EXPECT_DOUBLE_EQ(p.shear_modulus, numbers[2]) << name;
    EXPECT_DOUBLE_EQ(p.yield_stress, numbers[3]) << name;
    EXPECT_DOUBLE_EQ(p.viscosity, numbers[4]) << name;
    EXPECT_DOUBLE_EQ(p.flow_index, numbers[5]) << name;
    EXPECT_DOUBLE_EQ(s.materials[0].tearing.tear_threshold, numbers[6]) << name;
    EXPECT_DOUBLE_EQ(s.materials[0].tearing.recovery_time, numbers[7]) << name;
  }
}

TEST(MaterialCards, AreListedAsJsonWithTheirSource) {
  const Value cards = parse_json(material_cards());
  ASSERT_EQ(cards.array()->size(), 6U);
  for (const Value& card : *cards.array()) {
    EXPECT_NE(card.find("source")->text()->find("Table I"), std::string::npos);
    EXPECT_NE(card.find("density"), nullptr);
  }
}

TEST(Material, TakesWhatIsGivenOverItsCard) {
  const Scene s = parse_scene(with("/materials/0/viscosity", "0"));
  EXPECT_EQ(s.materials[0].herschel_bulkley().viscosity, 0);
  EXPECT_EQ(s.materials[0].herschel_bulkley().density, 77.7);
}

TEST(Material, WithoutYieldStressOrWithTheWordInfinityIsElastic) {
  const std::string elastic = R"("name": "foam", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 1e4)";
  for (const std::string& more : {std::string(), std::string(R"(, "yield_stress": "infinity")")}) {
    const Scene s = parse_scene(with("/materials/0", "{" + elastic + more + "}"));
    EXPECT_EQ(s.materials[0].herschel_bulkley().yield_stress, std::numeric_limits<double>::infinity());
    EXPECT_EQ(s.materials[0].herschel_bulkley().flow_index, 1);
    EXPECT_NE(to_json(s).find(R"("yield_stress": "infinity")"), std::string::npos);
  }
}

TEST(Scene, In2DTakesVectorsOfTwoOrThreeNumbers) {
  const std::string text = R"({"lather": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1, 5]},
    "duration": 1, "spacing": 0.05, "gravity": [0, -1], "materials": [{"name": "m", "preset": "pie"}],
    "bodies": [{"name": "b", "material": "m", "velocity": [1, 2],
                "shape": {"type": "box", "size": [0.4, 0.2], "translate": [0.5, 0.5]}}]})";
  const Scene s = parse_scene(text);
  EXPECT_EQ(s.domain.box.max, Vec3(1, 1, 0));
  EXPECT_EQ(s.bodies[0].velocity, Vec3(1, 2, 0));
  EXPECT_EQ(s.points_per_cell, 4);
  // The distance in the plane is the rectangle's, inside and outside.
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.5, 0.5, 0}), -0.1, 1e-15);
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.9, 0.5, 0}), 0.2, 1e-15);
  EXPECT_EQ(to_json(parse_scene(to_json(s))), to_json(s));
}

TEST(Scene, ShapesArePlacedByScaleThenTurnThenShift) {
  const Scene s =
      parse_scene(with("/bodies/0/shape", R"({"type": "capsule", "radius": 0.1, "height": 1, "scale": 0.5,
                                                          "rotate_deg": [0, 0, 90], "translate": [0.5, 0.5, 0.5]})"));
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.5 + 0.25 + 0.05 + 0.1, 0.5, 0.5}), 0.1, 1e-15);
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.5, 0.65, 0.5}), 0.1, 1e-15);
}

TEST(Scene, RoundedBoxIsAnotherNameForABoxWithRounding) {
  const std::string keys = R"("size": [0.4, 0.4, 0.4], "rounding": 0.1})";
  const Scene a = parse_scene(with("/bodies/0/shape", R"({"type": "rounded_box", )" + keys));
  const Scene b = parse_scene(with("/bodies/0/shape", R"({"type": "box", )" + keys));
  EXPECT_EQ(to_json(a), to_json(b));
}

TEST(Camera, IsPlacedByHandWhereAnEyeIsGiven) {
  EXPECT_FALSE(
      parse_scene(with("/look/camera", R"({"eye": [0, 0, 1], "target": [0, 0, 0]})")).look.camera.automatic);
  EXPECT_TRUE(parse_scene(with("/look/camera", R"({"field_of_view_deg": 50})")).look.camera.automatic);
}

TEST(Size, IsMergedIntoTheSceneAndReplacesListsWhole) {
  const std::string text = with("/sizes", R"({"preview": {"spacing": 0.1, "output": {"width": 320},
    "obstacles": [{"name": "lid", "shape": {"type": "plane"}}]}, "paper": {"output": null}})");
  EXPECT_EQ(parse_scene(text).spacing, 0.05);
  const Scene preview = parse_scene(text, "preview");
  EXPECT_EQ(preview.spacing, 0.1);
  EXPECT_EQ(preview.output.width, 320);
  EXPECT_EQ(preview.output.height, 720);
  ASSERT_EQ(preview.obstacles.size(), 1U);
  EXPECT_EQ(preview.obstacles[0].name, "lid");
}

TEST(Size, ThatIsNotNamedIsRefusedWithTheKnownOnes) {
  const auto problems = problems_of(with("/sizes", R"({"preview": {}, "paper": {}})"), "papre");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/sizes");
  EXPECT_EQ(problems[0].allowed, "\"preview\" or \"paper\"");
  EXPECT_EQ(problems_of(small_scene(), "preview").at(0).pointer, "/sizes");
}

TEST(Size, ProblemsPointToWhereTheValueStands) {
  const std::string text = with("/sizes", R"({"tiny": {"spacing": -1}})");
  EXPECT_EQ(problems_of(text).size(), 0U);
  EXPECT_EQ(problems_of(text, "tiny").at(0).pointer, "/sizes/tiny/spacing");
  EXPECT_EQ(problems_of(text, "tiny", {{"/spacing", "-2"}}).at(0).pointer, "/spacing");
}

TEST(Override, ComesAfterTheSize) {
  const std::string text = with("/sizes", R"({"preview": {"spacing": 0.1}})");
  const Scene s =
      parse_scene(text, "preview", {{"/spacing", "0.2"}, {"/numerics/transfer", "apic"}, {"/name", "a b"}});
  EXPECT_EQ(s.spacing, 0.2);
  EXPECT_EQ(s.numerics.transfer, Transfer::kApic);
  EXPECT_EQ(s.name, "a b");
}

TEST(Override, OfNullTakesTheFieldAway) {
  EXPECT_EQ(parse_scene(with("/frame_rate", "10"), "", {{"/frame_rate", "null"}}).frame_rate, 30);
}

TEST(Override, ThatCannotBeSetIsRefused) {
  for (const char* pointer : {"", "spacing", "/bodies/7/name", "/spacing/x", "/sizes/preview/spacing"}) {
    const auto problems = problems_of(small_scene(), "", {{pointer, "1"}});
    ASSERT_EQ(problems.size(), 1U) << pointer;
    EXPECT_EQ(problems[0].pointer, pointer);
  }
}

}  // namespace
}  // namespace lather::test
