#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "tests/unit/sim/scene/scene_texts.h"

namespace lather::test {
namespace {

/// Judges documents by scene_schema() with a validator that knows nothing of our tables.
class Referee {
 public:
  Referee() {
    document_ = nlohmann::json::parse(scene_schema());
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), schema_);
  }
  bool accepts(const std::string& text) {
    const nlohmann::json json = nlohmann::json::parse(text);
    valijson::Validator validator;
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
  }

 private:
  nlohmann::json document_;
  valijson::Schema schema_;
};

TEST(Schema, AcceptsEveryExampleAndEveryCanonicalText) {
  Referee referee;
  for (const std::string& text : {small_scene(), mlsrk_scene()}) {
    EXPECT_TRUE(referee.accepts(text));
    EXPECT_TRUE(referee.accepts(to_json(parse_scene(text))));
  }
  for (const auto& [name, text] : example_scenes()) {
    EXPECT_TRUE(referee.accepts(text)) << name;
    EXPECT_TRUE(referee.accepts(to_json(parse_scene(text)))) << name;
  }
}

/// Changes that break a rule of one field: the reader and the schema must both see them.
TEST(Schema, RefusesWhatTheReaderRefusesOfASingleField) {
  const std::vector<std::pair<std::string, std::string>> mutations = {
      {"/lather", "2"},
      {"/lather", "null"},
      {"/spacing", "null"},
      {"/spacing", "0"},
      {"/spacing", "\"0.05\""},
      {"/duration", "0"},
      {"/duration", "true"},
      {"/dimension", "2.5"},
      {"/points_per_cell", "65"},
      {"/points_per_cell", "true"},
      {"/seed", "-1"},
      {"/gravity", "[0]"},
      {"/gravity", "[0, 0, 0, 0]"},
      {"/unknown", "1"},
      {"/domain", "{\"min\": [0, 0, 0]}"},
      {"/domain/boundary", "\"wall\""},
      {"/domain/periodic", "[true, false]"},
      {"/materials", "[]"},
      {"/materials/0", "{\"name\": \"foam\"}"},
      {"/materials/0/preset", "\"soap\""},
      {"/materials/0/density", "-1"},
      {"/materials/0/yield_stress", "\"none\""},
      {"/materials/0/tear_threshold", "0"},
      {"/materials/0/recovery_time", "\"never\""},
      {"/materials/0/cohesion", "1"},
      {"/materials/0/model", "\"snow\""},
      {"/materials/0", R"({"name": "foam", "model": "liquid", "density": 1})"},
      {"/materials/0", R"({"name": "foam", "density": 1, "bulk_modulus": 1})"},
      {"/solver", "\"sph\""},
      {"/bodies/0/name", "\"\""},
      {"/bodies/0/shape/type", "\"spere\""},
      {"/bodies/0/shape/radius", "0"},
      {"/bodies/0/shape/radius", "null"},
      {"/bodies/0/shape/size", "[1, 1, 1]"},
      {"/bodies/0/shape", "{\"type\": \"union\", \"of\": [{\"type\": \"sphere\"}]}"},
      {"/obstacles/0/friction", "-0.1"},
      {"/obstacles/0/adhesive", "1"},
      {"/obstacles/0/motion", "{\"type\": \"linear\"}"},
      {"/obstacles/0/motion", "{\"type\": \"oscillation\", \"amplitude\": -1, \"frequency\": 1}"},
      {"/numerics", "{\"kernel\": \"linear\"}"},
      {"/numerics", "{\"flip_blend\": 1.01}"},
      {"/numerics", "{\"safety_factor\": 0}"},
      {"/numerics", R"({"mlsrk": {"basis": "cubic"}})"},
      {"/look", "{\"background\": [0, 0, 2]}"},
      {"/look", "{\"camera\": {\"field_of_view_deg\": 0}}"},
      {"/output", "{\"width\": 100000}"},
      {"/sizes", "{\"preview\": 1}"},
  };
  Referee referee;
  for (const auto& [pointer, json] : mutations) {
    const std::string text = with(pointer, json);
    EXPECT_FALSE(problems_of(text).empty()) << "reader accepts " << pointer << " = " << json;
    EXPECT_FALSE(referee.accepts(text)) << "schema accepts " << pointer << " = " << json;
  }
}

TEST(Schema, AcceptsWhatTheReaderAccepts) {
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"/materials/0/yield_stress", "\"infinity\""},
      {"/materials/0", R"({"name": "foam", "density": 1, "bulk_modulus": 1, "shear_modulus": 1})"},
      {"/bodies/0/shape",
       R"({"type": "union", "smoothing": 0.1, "of": [{"type": "box", "size": [1, 1, 1], "scale": 2}]})"},
      {"/bodies/0/shape", R"({"type": "revolution", "profile": [[0, 0], [0.3, 0], [0, 0.4]]})"},
      {"/obstacles/0/motion",
       R"({"type": "keyframes", "keys": [{"time": 0}, {"time": 1, "translate": [0, 1, 0]}]})"},
      {"/look", R"({"color_range": [0, 1], "camera": {"eye": [0, 0, 1], "target": [0, 0, 0]}})"},
  };
  Referee referee;
  for (const auto& [pointer, json] : changes) {
    const std::string text = with(pointer, json);
    EXPECT_EQ(problems_of(text).size(), 0U) << pointer << " = " << json;
    EXPECT_TRUE(referee.accepts(text)) << pointer << " = " << json;
  }
}

TEST(Schema, DescribesEveryFieldInWords) {
  const nlohmann::json schema = nlohmann::json::parse(scene_schema());
  for (const auto& [key, field] : schema["properties"].items()) {
    EXPECT_FALSE(field.value("description", "").empty()) << key;
  }
  EXPECT_EQ(schema["properties"]["frame_rate"]["default"], 30);
  EXPECT_EQ(schema["properties"]["spacing"]["x-unit"], "m");
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
}

}  // namespace
}  // namespace lather::test
