#include <gtest/gtest.h>

#include <array>

#include "sim/scene/value.h"
#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

/// One value put into a good scene, and what must be said about it.
struct Wrong {
  std::string set;  ///< where the value is put
  std::string json;
  std::string pointer;  ///< where the problem is
  std::string says;     ///< part of what is allowed, or of the message
};

void PrintTo(const Wrong& w, std::ostream* out) {
  *out << w.set << " = " << w.json;
}

class SceneError : public testing::TestWithParam<Wrong> {};

TEST_P(SceneError, HasItsPointerTheValueAndWhatIsAllowed) {
  const Wrong& w = GetParam();
  const std::vector<Problem> problems = problems_of(with(w.set, w.json));
  ASSERT_EQ(problems.size(), 1U) << (problems.empty() ? "accepted" : InputError(problems).what());
  const Problem& p = problems.front();
  EXPECT_EQ(p.pointer, w.pointer);
  EXPECT_NE((p.allowed + " | " + p.message).find(w.says), std::string::npos)
      << p.allowed << " | " << p.message;
  EXPECT_FALSE(p.message.empty());
  if (w.json != "null" && w.set == w.pointer) {
    EXPECT_EQ(p.value, write_json(parse_json(w.json)).substr(0, p.value.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Outputs, SceneError,
    testing::Values(Wrong{"/look/style", "\"fur\"", "/look/style", "\"points\" or \"skin\""},
                    Wrong{"/look", R"({"style": "skin", "color_by": "J"})", "/look/color_by",
                          "coloured by its material"},
                    Wrong{"/output/particles", R"(["obj"])", "/output/particles/0", "\"ply\" or \"vdb\""},
                    Wrong{"/output/skin", R"(["ply", "ply"])", "/output/skin/1", "named twice"},
                    Wrong{"/bodies/0/shape", R"({"type": "mesh"})", "/bodies/0/shape/file", "missing"},
                    Wrong{"/bodies/0/shape", R"({"type": "mesh", "file": "a.obj", "resolution": 8})",
                          "/bodies/0/shape/resolution", "from 16 to 256"}));

TEST(SceneErrors, ASkinInTwoDimensionsIsRefusedWhereItIsAskedFor) {
  const auto flat = [](const std::string& pointer, const std::string& json) {
    Value scene =
        parse_json(R"({"lather": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1]}, "duration": 1,
      "spacing": 0.05, "materials": [{"name": "foam", "preset": "shaving-cream"}],
      "bodies": [{"name": "ball", "material": "foam", "shape": {"type": "sphere", "radius": 0.2}}]})");
    set_at_pointer(scene, pointer, parse_json(json));
    return problems_of(write_json(scene));
  };
  for (const auto& [pointer, json] : {std::pair{"/look/style", "\"skin\""}, {"/output/skin", "[\"obj\"]"}}) {
    const std::vector<Problem> problems = flat(pointer, json);
    ASSERT_EQ(problems.size(), 1U) << pointer;
    EXPECT_EQ(problems[0].pointer, pointer);
    EXPECT_NE(problems[0].message.find("have no skin"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, SceneError,
    testing::Values(
        Wrong{"/spacing", "0", "/spacing", "from 1e-06 to 1000 m"},
        Wrong{"/spacing", "-0.05", "/spacing", "from 1e-06 to 1000 m"},
        Wrong{"/spacing", "\"0.05\"", "/spacing", "must be a number"},
        Wrong{"/spacing", "true", "/spacing", "must be a number"},
        Wrong{"/spacing", "[0.05]", "/spacing", "must be a number"},
        Wrong{"/spacing", "null", "/spacing", "\"spacing\" is missing"},
        Wrong{"/duration", "0", "/duration", "from 0 (not itself) to"},
        Wrong{"/gravity", "[0, -9.81]", "/gravity", "3 numbers"},
        Wrong{"/gravity", "[0, -9.81, \"0\"]", "/gravity/2", "must be a number"},
        Wrong{"/jitter", "1.5", "/jitter", "from 0 to 1"},
        Wrong{"/materials/0/density", "-1", "/materials/0/density", "from 0.001 to 100000 kg/m^3"},
        Wrong{"/materials/0/yield_stress", "\"infinite\"", "/materials/0/yield_stress", "\"infinity\""},
        Wrong{"/materials/0/flow_index", "0", "/materials/0/flow_index", "from 0.05 to 10"},
        Wrong{"/look/background", "[0, 0, 1.1]", "/look/background/2", "from 0 to 1"},
        Wrong{"/look/color_range", "[1, 1]", "/look/color_range", "the first below the second"},
        Wrong{"/bodies/0/velocity_gradient", "[[0,0,0],[0,0],[0,0,0]]", "/bodies/0/velocity_gradient/1",
              "3 numbers"}));

INSTANTIATE_TEST_SUITE_P(
    WholeNumbers, SceneError,
    testing::Values(Wrong{"/points_per_cell", "1e30", "/points_per_cell", "whole number"},
                    Wrong{"/points_per_cell", "4294967304", "/points_per_cell", "from 1 to 64"},
                    Wrong{"/points_per_cell", "-1", "/points_per_cell", "from 1 to 64"},
                    Wrong{"/points_per_cell", "2.9", "/points_per_cell", "whole number"},
                    Wrong{"/points_per_cell", "true", "/points_per_cell", "whole number"},
                    Wrong{"/points_per_cell", "9", "/points_per_cell", "1, 8, 27 or 64"},
                    Wrong{"/seed", "-1", "/seed", "from 0 to"},
                    Wrong{"/seed", "1e17", "/seed", "whole number"},
                    Wrong{"/output/width", "0", "/output/width", "from 16 to 16384"},
                    Wrong{"/dimension", "4", "/dimension", "from 2 to 3"},
                    Wrong{"/lather", "2", "/lather", "not known"},
                    Wrong{"/lather", "null", "/lather", "missing"}));

INSTANTIATE_TEST_SUITE_P(
    Kinds, SceneError,
    testing::Values(
        Wrong{"/look/floor", "1", "/look/floor", "true or false"},
        Wrong{"/look/floor", "\"true\"", "/look/floor", "true or false"},
        Wrong{"/name", "5", "/name", "must be text"}, Wrong{"/bodies", "{}", "/bodies", "must be a list"},
        Wrong{"/bodies", "[]", "/bodies", "1 to"}, Wrong{"/bodies/0", "7", "/bodies/0", "must be an object"},
        Wrong{"/materials/0", "\"foam\"", "/materials/0", "must be an object"},
        Wrong{"/domain", "[]", "/domain", "must be an object"}, Wrong{"/sizes", "[]", "/sizes", "object"},
        Wrong{"/sizes", R"({"preview": 3})", "/sizes/preview", "object"},
        Wrong{"/numerics/kernel", "\"cubik\"", "/numerics/kernel", "Did you mean \"cubic\"?"},
        Wrong{"/domain/boundary", "\"wall\"", "/domain/boundary", "\"slip\", \"stick\" or \"open\""},
        Wrong{"/materials/0/preset", "\"shaving-creme\"", "/materials/0/preset", "shaving-cream"},
        Wrong{"/materials/0/model", "\"newtonian\"", "/materials/0/model", "herschel-bulkley"}));

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, SceneError,
    testing::Values(Wrong{"/spaceing", "1", "/spaceing", "Did you mean \"spacing\"?"},
                    Wrong{"/numerics/timestep", "1", "/numerics/timestep", "Did you mean \"time_step\"?"},
                    Wrong{"/materials/0/tear_treshold", "1", "/materials/0/tear_treshold",
                          "Did you mean \"tear_threshold\"?"},
                    Wrong{"/materials/0/cohesion", "1", "/materials/0/cohesion",
                          "goes with the model \"drucker-prager\""},
                    Wrong{"/bodies/0/shape/raduis", "1", "/bodies/0/shape/raduis",
                          "Did you mean \"radius\"?"},
                    Wrong{"/a~1b", "1", "/a~1b", "not known here"},
                    Wrong{"/look/camera/fov", "30", "/look/camera/fov", "not known here"}));

INSTANTIATE_TEST_SUITE_P(
    Shapes, SceneError,
    testing::Values(
        Wrong{"/bodies/0/shape", R"({"radius": 1})", "/bodies/0/shape/type", "missing"},
        Wrong{"/bodies/0/shape/type", "\"spere\"", "/bodies/0/shape/type", "Did you mean \"sphere\"?"},
        Wrong{"/bodies/0/shape/radius", "0", "/bodies/0/shape/radius", "from 0 (not itself)"},
        Wrong{"/bodies/0/shape/scale", "0", "/bodies/0/shape/scale", "from 1e-06"},
        Wrong{"/bodies/0/shape", R"({"type": "box", "size": [1, 2, 1], "rounding": 0.6})",
              "/bodies/0/shape/rounding", "0.5 m"},
        Wrong{"/bodies/0/shape", R"({"type": "rounded_box", "size": [1, 1, 1]})", "/bodies/0/shape/rounding",
              "missing"},
        Wrong{"/bodies/0/shape", R"({"type": "cylinder", "radius": 1, "height": 1, "rounding": 0.6})",
              "/bodies/0/shape/rounding", "0.5 m"},
        Wrong{"/bodies/0/shape", R"({"type": "cone", "radius": 0, "height": 1})", "/bodies/0/shape/radius",
              "above 0"},
        Wrong{"/bodies/0/shape", R"({"type": "torus", "ring_radius": 1, "tube_radius": 2})",
              "/bodies/0/shape/tube_radius", "ring_radius"},
        Wrong{"/bodies/0/shape", R"({"type": "plane", "normal": [0, 0, 0]})", "/bodies/0/shape/normal",
              "not all zero"},
        Wrong{"/bodies/0/shape", R"({"type": "revolution", "profile": [[0, 0], [1, 0]]})",
              "/bodies/0/shape/profile", "3 to"},
        Wrong{"/bodies/0/shape", R"({"type": "revolution", "profile": [[0, 0], [1, 0], [-1, 1]]})",
              "/bodies/0/shape/profile/2", "beyond the axis"},
        Wrong{"/bodies/0/shape", R"({"type": "revolution", "profile": [[0, 0], [1, 0], [2, 0]]})",
              "/bodies/0/shape/profile", "flat"},
        Wrong{"/bodies/0/shape", R"({"type": "union", "of": []})", "/bodies/0/shape/of", "1 to"},
        Wrong{"/bodies/0/shape", R"({"type": "difference", "of": [{"type": "sphere", "radius": -1}]})",
              "/bodies/0/shape/of/0/radius", "from 0 (not itself)"}));

INSTANTIATE_TEST_SUITE_P(
    Motions, SceneError,
    testing::Values(
        Wrong{"/obstacles/0/motion", R"({"type": "linear"})", "/obstacles/0/motion/velocity", "missing"},
        Wrong{"/obstacles/0/motion", R"({"type": "linear", "velocity": [1, 0, 0], "start": 2, "end": 1})",
              "/obstacles/0/motion/end", "later than start, 2 s"},
        Wrong{"/obstacles/0/motion", R"({"type": "rotation", "rate_deg": 5, "axis": [0, 0, 0]})",
              "/obstacles/0/motion/axis", "not all zero"},
        Wrong{"/obstacles/0/motion", R"({"type": "keyframes", "keys": [{"time": 1}, {"time": 1}]})",
              "/obstacles/0/motion/keys/1/time", "later than 1 s"}));

INSTANTIATE_TEST_SUITE_P(
    Wholes, SceneError,
    testing::Values(Wrong{"/bodies/0/material", "\"fome\"", "/bodies/0/material", "Did you mean \"foam\"?"},
                    Wrong{"/obstacles/0/adhesive", "true", "/obstacles/0/friction", "adhesive"},
                    Wrong{"/domain/max", "[1, 0, 1]", "/domain/max/1", "above min"},
                    Wrong{"/spacing", "0.3", "/spacing", "to 0.25 m"},
                    Wrong{"/spacing", "0.00001", "/spacing", "from 3.125e-05 to 0.25 m"},
                    Wrong{"/duration", "5000", "/duration", "at most 3333.3"},
                    Wrong{"/look/camera", R"({"eye": [0, 0, 1]})", "/look/camera/target", "needs \"target\""},
                    Wrong{"/look/camera", R"({"eye": [0, 0, 1], "target": [0, 0, 1]})", "/look/camera/eye",
                          "other than the target"},
                    Wrong{"/domain",
                          R"({"min": [0, 0, 0], "max": [1.05, 1, 1], "periodic": [true, false, false]})",
                          "/domain/periodic/0", "e.g. 1 m"}));

TEST(SceneErrors, MissingParametersOfAMaterialAreAllNamed) {
  const auto problems = problems_of(with("/materials/0", R"({"name": "foam"})"));
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].pointer, "/materials/0/density");
  EXPECT_EQ(problems[1].pointer, "/materials/0/bulk_modulus");
  EXPECT_EQ(problems[2].pointer, "/materials/0/shear_modulus");
}

TEST(SceneErrors, AreCollectedNotStoppedAtTheFirst) {
  std::vector<Override> wrong = {{"/spacing", "-1"},
                                 {"/duration", "true"},
                                 {"/extra", "1"},
                                 {"/bodies/0/shape/radius", "\"big\""},
                                 {"/output/height", "2.5"}};
  const auto problems = problems_of(small_scene(), "", wrong);
  EXPECT_EQ(problems.size(), wrong.size());
  for (const Override& w : wrong) {
    EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
      return p.pointer == w.pointer;
    })) << w.pointer;
  }
}

/// A scene whose only material comes from one emitter, `keys` being its own beside name and shape.
std::string with_emitter(const std::string& keys) {
  Value scene = parse_json(with("/emitters", R"([{"name": "e", "shape": {"type": "sphere", "radius": 0.1})" +
                                                 (keys.empty() ? "" : ", " + keys) + "}]"));
  set_at_pointer(scene, "/bodies", nullptr);
  return write_json(scene);
}

TEST(SceneErrors, OfEmittersSayWhatIsAllowed) {
  EXPECT_TRUE(problems_of(with_emitter(R"("material": "foam")")).empty());
  EXPECT_TRUE(problems_of(with_emitter(R"("material": "foam", "count": 3, "interval": 0.1)")).empty());
  EXPECT_TRUE(
      problems_of(with_emitter(R"("material": "foam", "stream": true, "velocity": [0, -1, 0])")).empty());
  const std::vector<std::array<const char*, 3>> wrong = {
      {"", "/emitters/0/material", "missing"},
      {R"("material": "fome")", "/emitters/0/material", "Did you mean \"foam\"?"},
      {R"("material": "foam", "count": 0)", "/emitters/0/count", "from 1 to 1000000"},
      {R"("material": "foam", "count": 2)", "/emitters/0/interval", "above 0 s"},
      {R"("material": "foam", "end": 2)", "/emitters/0/end", "only where stream is true"},
      {R"("material": "foam", "start": -1)", "/emitters/0/start", "from 0"},
      {R"("material": "foam", "stream": true)", "/emitters/0/velocity", "not zero"},
      {R"("material": "foam", "stream": true, "velocity": [0, -1, 0], "count": 4)", "/emitters/0/count",
       "only where stream is false"},
      {R"("material": "foam", "stream": true, "velocity": [0, -1, 0], "spin_deg": [0, 1, 0])",
       "/emitters/0/spin_deg", "only where stream is false"},
      {R"("material": "foam", "stream": true, "velocity": [0, -1, 0], "start": 1, "end": 0.5)",
       "/emitters/0/end", "later than start"}};
  for (const auto& [keys, pointer, says] : wrong) {
    const auto problems = problems_of(with_emitter(keys));
    ASSERT_EQ(problems.size(), 1U) << keys;
    EXPECT_EQ(problems[0].pointer, pointer);
    EXPECT_NE((problems[0].allowed + problems[0].message).find(says), std::string::npos)
        << problems[0].allowed;
  }
}

TEST(SceneErrors, OfProbesSayWhatIsAllowed) {
  const std::vector<std::array<const char*, 3>> wrong = {
      {R"({"type": "farce", "name": "f"})", "/probes/0/type", "Did you mean \"force\"?"},
      {R"({"type": "force", "name": "f"})", "/probes/0/obstacle", "missing"},
      {R"({"type": "force", "name": "f", "obstacle": "grund"})", "/probes/0/obstacle",
       "Did you mean \"ground\"?"},
      {R"({"type": "point", "name": "p", "at": [0, 0, 0], "obstacle": "wall"})", "/probes/0/obstacle",
       "ground"},
      {R"({"type": "plane", "name": "p", "point": [0, 0, 0], "size": [1, 0]})", "/probes/0/size",
       "above 0 m"},
      {R"({"type": "plane", "name": "p", "point": [0, 0, 0], "size": [1, 1]})", "/probes/0/along",
       "across the normal"},
      {R"({"type": "plane", "name": "p", "point": [0, 0, 0], "size": [1, 1], "along": [0, 2, 0]})",
       "/probes/0/along", "across the normal"},
      {R"({"type": "plane", "name": "p", "point": [0, 0, 0], "size": [1, 1], "along": [1, 0, 0], "radius": 1})",
       "/probes/0/radius", "only without size"},
      {R"({"type": "walls", "name": "w", "interval": 1e-9})", "/probes", "1000000 samples"}};
  for (const auto& [probe, pointer, says] : wrong) {
    const auto problems = problems_of(with("/probes", std::string("[") + probe + "]"));
    ASSERT_EQ(problems.size(), 1U) << probe;
    EXPECT_EQ(problems[0].pointer, pointer);
    EXPECT_NE((problems[0].allowed + problems[0].message).find(says), std::string::npos)
        << problems[0].message;
  }
}

TEST(SceneErrors, ForceProbesAreRefusedWhereStepsAreSemiImplicit) {
  const std::string probed =
      with("/probes", R"([{"type": "point", "name": "p", "at": [0, 0, 0]}, {"type": "walls", "name": "w"}])");
  EXPECT_TRUE(problems_of(probed).empty());
  const auto problems = problems_of(probed, "", {{"/numerics/integration", "semi-implicit"}});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/probes/1/type");
}

TEST(SceneErrors, ASceneNeedsBodiesOrEmitters) {
  const auto problems = problems_of(with("/bodies", "null"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/bodies");
  EXPECT_NE(problems[0].message.find("\"bodies\" is missing"), std::string::npos);
}

TEST(SceneErrors, NamesOfEmittersGivenTwiceAreRefused) {
  constexpr const char* kTwo =
      R"([{"name": "e", "material": "foam", "shape": {"type": "sphere", "radius": 0.1}},
                                   {"name": "e", "material": "foam", "shape": {"type": "sphere", "radius": 0.2}}])";
  const auto problems = problems_of(with("/emitters", kTwo));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/emitters/1/name");
}

TEST(SceneErrors, NamesGivenTwiceAreRefused) {
  const auto problems = problems_of(with("/materials", R"([{"name": "foam", "preset": "pie"},
                                                           {"name": "foam", "preset": "oobleck"}])"));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].pointer, "/materials/1/name");
}

TEST(SceneErrors, AnythingButAnObjectIsNoScene) {
  for (const char* text : {"[]", "3", "\"scene\"", "null", "true"}) {
    ASSERT_EQ(problems_of(text).size(), 1U) << text;
    EXPECT_EQ(problems_of(text)[0].pointer, "");
  }
}

TEST(SceneErrors, LongValuesAreShownShortened) {
  const auto problems = problems_of(with("/spacing", "\"" + std::string(5000, 'x') + "\""));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_LT(problems[0].value.size(), 100U);
}

TEST(SceneErrors, MotionOutOfThePlaneOfA2DSceneIsRefused) {
  Value scene = parse_json(with_emitter(R"("material": "foam")"));
  set_at_pointer(
      scene, "/bodies",
      parse_json(R"([{"name": "b", "material": "foam", "shape": {"type": "sphere", "radius": 0.2}}])"));
  set_at_pointer(scene, "/dimension", std::int64_t{2});
  const std::string flat = write_json(scene);
  const std::vector<std::pair<const char*, const char*>> across = {
      {"/gravity", "[0, -9.81, 1]"},         {"/bodies/0/velocity", "[0, 0, 1]"},
      {"/bodies/0/spin_deg", "[1, 0, 0]"},   {"/bodies/0/velocity_gradient", "[[0,0,0],[0,0,0],[1,0,0]]"},
      {"/emitters/0/velocity", "[0, 0, 1]"}, {"/emitters/0/spin_deg", "[0, 1, 0]"},
  };
  for (const auto& [pointer, json] : across) {
    const auto problems = problems_of(flat, "", {{pointer, json}});
    ASSERT_EQ(problems.size(), 1U) << pointer;
    EXPECT_EQ(problems[0].pointer, pointer);
    EXPECT_EQ(problems[0].value, write_json(parse_json(json)));
  }
  EXPECT_EQ(problems_of(flat, "", {{"/points_per_cell", "8"}}).at(0).allowed, "1, 4, 9 or 16");
}

}  // namespace
}  // namespace lather::test
