#include <gtest/gtest.h>

#include "sim/scene/value.h"
#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

/// A scene in which every key of every kind of shape and motion has a value of its own.
std::string full_scene() {
  return R"({"lather": 1, "name": "every key", "solver": "mpm", "dimension": 3,
    "domain": {"min": [-0.1, -0.2, -0.3], "max": [0.7, 1, 1.3], "periodic": [true, false, true], "boundary": "open"},
    "gravity": [0.1, -9.7, 0.3], "duration": 1.25, "frame_rate": 24, "spacing": 0.05, "points_per_cell": 27,
    "materials": [{"name": "a", "preset": "pie", "density": 300.5},
                  {"name": "b", "density": 1e3, "bulk_modulus": 12345.678, "shear_modulus": 0.1, "yield_stress": 3,
                   "viscosity": 0.3, "flow_index": 0.7},
                  {"name": "c", "density": 1, "bulk_modulus": 1, "shear_modulus": 1, "yield_stress": "infinity"}],
    "bodies": [{"name": "all", "material": "b", "velocity": [1, 2, 3], "spin_deg": [4, 5, 6],
                "velocity_gradient": [[1, 2, 3], [4, 5, 6], [7, 8, 9]],
      "shape": {"type": "union", "smoothing": 0.01, "scale": 2, "of": [
        {"type": "sphere", "radius": 0.1},
        {"type": "rounded_box", "size": [0.1, 0.2, 0.3], "rounding": 0.04, "translate": [0.1, 0, 0]},
        {"type": "cylinder", "radius": 0.1, "height": 0.3, "rounding": 0.02, "rotate_deg": [10, 20, 30]},
        {"type": "capsule", "radius": 0.1, "height": 0.3}, {"type": "cone", "radius": 0.2, "top_radius": 0.1, "height": 0.3},
        {"type": "torus", "ring_radius": 0.2, "tube_radius": 0.05}, {"type": "ellipsoid", "radii": [0.1, 0.2, 0.3]},
        {"type": "intersection", "of": [{"type": "plane", "normal": [0, 1, 1]}, {"type": "box", "size": [1, 1, 1]}]},
        {"type": "difference", "of": [{"type": "revolution", "profile": [[0, 0], [0.1, 0], [0, 0.3]]},
                                      {"type": "sphere", "radius": 0.05}]}]}}],
    "emitters": [
      {"name": "drops", "material": "a", "shape": {"type": "sphere", "radius": 0.1}, "velocity": [0, -1, 0],
       "spin_deg": [1, 2, 3], "start": 0.1, "interval": 0.2, "count": 5},
      {"name": "stream", "material": "b", "shape": {"type": "sphere", "radius": 0.1}, "velocity": [0, -1, 0],
       "stream": true, "end": 0.7}],
    "obstacles": [
      {"name": "a", "shape": {"type": "plane"}, "adhesive": true, "visible": false,
       "motion": {"type": "linear", "velocity": [1, 0, 0], "start": 0.1, "end": 0.2}},
      {"name": "b", "shape": {"type": "plane"}, "friction": 0.25,
       "motion": {"type": "oscillation", "direction": [0, 1, 0], "amplitude": 0.1, "frequency": 2, "phase_deg": 30}},
      {"name": "c", "shape": {"type": "plane"},
       "motion": {"type": "rotation", "center": [1, 2, 3], "axis": [0, 0, 1], "rate_deg": 90, "end": 3}},
      {"name": "d", "shape": {"type": "plane"}, "motion": {"type": "keyframes", "keys": [
        {"time": 0}, {"time": 0.5, "translate": [0, 0.1, 0], "rotate_deg": [0, 45, 0]}]}}],
    "probes": [{"type": "force", "name": "f", "obstacle": "b", "about": [1, 2, 3], "interval": 0.5},
               {"type": "walls", "name": "w", "about": [3, 2, 1]},
               {"type": "point", "name": "p", "at": [1, 1, 1], "obstacle": "a"},
               {"type": "plane", "name": "disc", "point": [1, 1, 1], "normal": [1, 1, 0], "radius": 0.1},
               {"type": "plane", "name": "slot", "point": [1, 1, 1], "along": [1, 0, 0], "size": [0.1, 0.2]}],
    "seed": 9007199254740991, "jitter": 0.1,
    "numerics": {"kernel": "quadratic", "transfer": "apic", "precision": "double", "flip_blend": 0.9,
                 "flip_blend_reference_step": 2e-5, "time_step": 1e-4, "safety_factor": 0.3, "max_time_step": 0.01},
    "look": {"camera": {"eye": [1, 2, 3], "target": [0, 0.5, 0], "field_of_view_deg": 40}, "color_by": "J",
             "color_range": [0.9, 1.1], "color_map": "inferno",
             "material_colors": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "background": [0.1, 0.2, 0.3], "floor": false,
             "legend": false, "shadows": false, "point_scale": 1.2, "style": "points"},
    "output": {"width": 640, "height": 360, "supersampling": 3, "particles": ["vdb", "ply"],
               "skin": ["obj"], "scalars": ["speed"]}})";
}

/// Every key and value of `given` stands in `written`, or `written` holds more.
void expect_holds(const Value& written, const Value& given, const std::string& pointer) {
  if (const Object* object = given.object()) {
    for (const auto& [key, value] : *object) {
      const Value* found = written.find(key);
      ASSERT_NE(found, nullptr) << pointer << "/" << key;
      if (key != "type") expect_holds(*found, value, pointer + "/" + key);  // rounded_box is written as box
    }
  } else if (const Array* array = given.array()) {
    ASSERT_EQ(written.array()->size(), array->size()) << pointer;
    for (std::size_t i = 0; i < array->size(); ++i) {
      expect_holds((*written.array())[i], (*array)[i], pointer + "/" + std::to_string(i));
    }
  } else {
    const auto plain = [](const Value& v) {
      const auto* whole = std::get_if<std::int64_t>(&v.data);
      return whole != nullptr ? write_json(Value(static_cast<double>(*whole))) : write_json(v);
    };
    EXPECT_EQ(plain(written), plain(given)) << pointer;
  }
}

TEST(RoundTrip, KeepsEveryValueOfEveryKey) {
  const std::string written = to_json(parse_scene(full_scene()));
  expect_holds(parse_json(written), parse_json(full_scene()), "");
}

TEST(RoundTrip, OfTheCanonicalTextIsItself) {
  for (const std::string& text : {small_scene(), full_scene()}) {
    const std::string once = to_json(parse_scene(text));
    EXPECT_EQ(to_json(parse_scene(once)), once);
  }
  for (const auto& [name, text] : example_scenes()) {
    const std::string once = to_json(parse_scene(text));
    EXPECT_EQ(to_json(parse_scene(once)), once) << name;
  }
}

TEST(RoundTrip, DoesNotDependOnTheOrderOfKeysOrOnDefaultsWrittenOut) {
  const Scene plain = parse_scene(small_scene());
  const Scene spelled = parse_scene(with("/frame_rate", "30.0"));
  EXPECT_EQ(to_json(plain), to_json(spelled));
  EXPECT_EQ(scene_hash(plain), scene_hash(spelled));
}

TEST(RoundTrip, OfAPlacementPlacedAgainKeepsTheShape) {
  Scene s = parse_scene(small_scene());
  s.bodies[0].shape =
      std::make_shared<const Shape>(Shape{PlacedShape(s.bodies[0].shape, {0.1, 0, 0}, {0, 0, 30}, 0.5)});
  const Scene back = parse_scene(to_json(s));
  for (const Vec3& x : {Vec3(0.1, 0.2, 0.3), Vec3(0.5, 0.5, 0.5), Vec3(1, 0, 0)}) {
    EXPECT_NEAR(distance(*back.bodies[0].shape, x), distance(*s.bodies[0].shape, x), 1e-15);
  }
  EXPECT_EQ(to_json(back), to_json(s));
}

TEST(SceneHash, IsTheSha256OfTheCanonicalTextAndChangesWithTheScene) {
  const Scene s = parse_scene(small_scene());
  EXPECT_EQ(scene_hash(s).size(), 64U);
  EXPECT_EQ(scene_hash(s).find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(scene_hash(s), scene_hash(parse_scene(with("/seed", "1"))));
}

TEST(Reference, NamesEveryKeyAndEveryCard) {
  const std::string reference = scene_reference();
  const Value written = parse_json(to_json(parse_scene(full_scene())));
  for (const auto& [key, value] : *written.object())
    EXPECT_NE(reference.find("`" + key + "`"), std::string::npos) << key;
  for (const char* word : {"### torus", "### oscillation", "`smoothing`", "`flip_blend`", "`shaving-cream`",
                           "Pa s^h", "from 0.001 to 100000 kg/m^3", "`rotate_deg`", "`sizes`"}) {
    EXPECT_NE(reference.find(word), std::string::npos) << word;
  }
}

TEST(Examples, AreGoodAtEverySizeThatTheyName) {
  ASSERT_GE(example_scenes().size(), 4U);
  for (const auto& [name, text] : example_scenes()) {
    EXPECT_EQ(problems_of(text).size(), 0U) << name;
    const Value document = parse_json(text);
    if (document.find("sizes") == nullptr) continue;
    for (const auto& [size, patch] : *document.find("sizes")->object()) {
      EXPECT_EQ(problems_of(text, size).size(), 0U) << name << " " << size;
    }
  }
}

// The paper's run starts with 54,695 points on 84^3 cells of 3.0 mm.
TEST(Examples, TheShavingCreamHasThePapersPointsAndGrid) {
  std::string text;
  for (const auto& [name, content] : example_scenes()) {
    if (name == "shaving-cream-shake.json") text = content;
  }
  const Scene s = parse_scene(text, "paper");
  EXPECT_TRUE(s.domain.box.extent().isApprox(Vec3::Constant(84 * s.spacing)));
  EXPECT_EQ(s.spacing, 0.003);
  EXPECT_EQ(s.numerics.time_step, 1e-5);
  const double d = s.spacing / 2;
  int points = 0;
  for (int i = 0; i < 168; ++i) {
    for (int j = 0; j < 168; ++j) {
      for (int k = 0; k < 168; ++k) {
        const Vec3 x = s.domain.box.min + d * Vec3(i + 0.5, j + 0.5, k + 0.5);
        if (distance(*s.bodies[0].shape, x) < 0) ++points;
      }
    }
  }
  EXPECT_NEAR(points, 54'695, 0.05 * 54'695);
}

}  // namespace
}  // namespace lather::test
