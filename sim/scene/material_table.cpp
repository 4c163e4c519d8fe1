#include <algorithm>

#include "sim/scene/material_cards.h"
#include "sim/scene/models.h"
#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

std::vector<std::string> card_names() {
  std::vector<std::string> names;
  for (const MaterialCard& card : all_material_cards()) names.push_back(card.name);
  return names;
}

/// The name of a card; nothing stands for none.
Field<Material> preset_field() {
  Field<Material> out =
      optional<Material>("preset", &Material::preset, one_of(card_names()),
                         "the material card that gives all parameters not given here", "none");
  out.write = [](const Material& m) {
    return m.preset.empty() ? std::nullopt : std::optional<Value>(m.preset);
  };
  return out;
}

/// The name of a law; reading it starts the material with that law's defaults.
Field<Material> model_field() {
  std::vector<std::string> names;
  for (const Model& m : models()) names.push_back(m.name);
  Codec<Law> codec;
  const Codec<std::string> by_name = one_of(names);
  codec.schema = by_name.schema;
  codec.allowed = by_name.allowed;
  codec.read = [by_name](const Value& value, Law& law, const Place& place) {
    std::string name;
    if (!by_name.read(value, name, place)) return false;
    for (const Model& m : models())
      if (m.name == name) law = m.start;
    return true;
  };
  codec.write = [](const Law& law) { return Value(model_of(law).name); };
  return optional<Material>("model", &Material::law, codec, "the constitutive law, see below");
}

/// The keys that a material of this model takes. Cards and tearing are of the default one.
std::vector<FieldInfo> gathered_keys(const Model& model) {
  const bool is_default = &model == &default_model();
  std::vector<FieldInfo> out;
  for (const FieldInfo& field : material().info().fields)
    if (is_default || field.name != "preset") out.push_back(field);
  out.insert(out.end(), model.info.fields.begin(), model.info.fields.end());
  const std::vector<FieldInfo>& tears = tearing().info().fields;
  if (is_default) out.insert(out.end(), tears.begin(), tears.end());
  return out;
}

const std::vector<FieldInfo>& keys_of(const Model& model) {
  static const std::vector<std::vector<FieldInfo>> keys = [] {
    std::vector<std::vector<FieldInfo>> all;
    for (const Model& m : models()) all.push_back(gathered_keys(m));
    return all;
  }();
  return keys[model.start.index()];
}

bool has_key(const std::vector<FieldInfo>& fields, const std::string& key) {
  return std::any_of(fields.begin(), fields.end(), [&](const FieldInfo& f) { return f.name == key; });
}

/// Notes the keys that another model takes, or none.
void refuse_keys(const Object& object, const Model& model, const Place& place) {
  const std::vector<FieldInfo>& keys = keys_of(model);
  std::vector<std::string> known;
  for (const FieldInfo& field : keys) known.push_back(field.name);
  Object rest;
  for (const auto& [key, value] : object) {
    std::vector<std::string> takers;
    for (const Model& m : models())
      if (has_key(keys_of(m), key)) takers.push_back(m.name);
    if (takers.empty() || has_key(keys, key)) {
      rest.emplace_back(key, value);
      continue;
    }
    place.at(key).refuse(value, listed(known),
                         "\"" + key + "\" goes with the model " + listed(takers) +
                             "; this material is of the model \"" + model.name +
                             "\". Take the key out, or name another \"model\".");
  }
  refuse_unknown_keys(rest, known, place);
}

/// The model's parameters that are single numbers.
std::vector<std::string> numbers_of(const Model& model) {
  std::vector<std::string> names;
  for (const FieldInfo& field : model.info.fields)
    if (!field.unit.empty()) names.push_back(field.name);
  return names;
}

/// The parameters that change with the concentration, at one.
Object values_at(const Phase& phase, double concentration) {
  Object values;
  for (const auto& [key, curve] : phase.by_concentration)
    values.emplace_back(key, value_at(curve, concentration));
  return values;
}

/// Each curve is a parameter of the model, not given as a number too, and keeps within its range.
bool check_curves(const Value& value, const Material& material, const Model& model, const Place& place) {
  const Place curves = place.at("phase").at("by_concentration");
  bool good = true;
  const Value& given = *value.find("phase");
  const Object& keys = *given.find("by_concentration")->object();
  const std::vector<std::string> known = numbers_of(model);
  for (const auto& [key, curve] : keys) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      const std::string near = nearest_name(key, known);
      good = curves.at(key).refuse(curve, listed(known),
                                   "The model \"" + model.name + "\" has no such parameter." +
                                       (near.empty() ? "" : " Did you mean \"" + near + "\"?"));
    } else if (value.find(key) != nullptr) {
      good = place.at(key).refuse(value.find(key), "left out, as /phase/by_concentration gives it",
                                  "\"" + key + "\" is given twice: as a number, and by concentration.");
    }
  }
  for (int k = 0; good && k <= kConcentrationNodes; ++k) {
    Law law = model.start;
    const double c = static_cast<double>(k) / kConcentrationNodes;
    good = model.read(values_at(*material.phase, c), law, curves, true);
  }
  return good;
}

bool read_material(const Value& value, Material& out, const Place& place) {
  if (value.object() == nullptr) return place.refuse(value, "an object", "A material must be an object.");
  out.law = default_model().start;
  out.tearing = tearing().prototype();
  const bool good = material().read_fields(value, out, place);
  const Model& model = model_of(out.law);
  const Value* named = value.find("model");
  if (named != nullptr && (named->text() == nullptr || *named->text() != model.name)) return false;
  refuse_keys(*value.object(), model, place);
  const MaterialCard* card = find_material_card(out.preset);
  if (card != nullptr && &model == &default_model()) {
    out.law = card->parameters;
    out.tearing = card->tearing;
  }
  const bool tears_well = tearing().read_fields(value, out.tearing, place);
  const bool complete = &model == &default_model() && value.find("preset") != nullptr;
  if (!good || !out.phase || out.phase->by_concentration.empty())
    return model.read(value, out.law, place, complete) && tears_well && good;
  if (!check_curves(value, out, model, place)) return false;
  Value at_start = value;
  for (auto& [key, number] : values_at(*out.phase, out.phase->concentration))
    at_start.object()->emplace_back(key, std::move(number));
  return model.read(at_start, out.law, place, complete) && tears_well;
}

/// The JSON Schema of a material of this model. Of the default one neither the model need be named nor, with
/// a preset, any parameter. A phase may give some by concentration; which, the schema does not know.
Object schema_of(const Model& model) {
  const bool is_default = &model == &default_model();
  TableInfo table = {model.name, model.info.words, keys_of(model)};
  Array parameters;
  for (FieldInfo& field : table.fields) {
    if (field.name == "model") {
      field.schema = {{"const", model.name}};
      if (!is_default) field.default_value.reset();
      field.presence = is_default ? Presence::kOptional : Presence::kRequired;
    } else if (field.presence == Presence::kRequired && field.name != "name") {
      parameters.emplace_back(field.name);
      field.presence = Presence::kOptional;
    }
  }
  Object schema = object_schema(table);
  Array ways = {Object{{"required", parameters}}, Object{{"required", Array{"phase"}}}};
  if (is_default) ways.emplace_back(Object{{"required", Array{"preset"}}});
  schema.emplace_back("anyOf", std::move(ways));
  return schema;
}

}  // namespace

const Table<Material>& material() {
  static const Table<Material> table(
      "material",
      "What a body is made of: a card by name, the parameters of a model, or a card with some parameters "
      "replaced. Cards and tearing are of the model \"herschel-bulkley\".",
      {required<Material>("name", &Material::name, text(1, 64), "by which bodies refer to it"), model_field(),
       preset_field(),
       switchable<Material>("phase", &Material::phase, phase(),
                            "it carries a concentration that diffuses (solver \"mlsrk\")")});
  return table;
}

const Table<TearingParameters>& tearing() {
  using P = TearingParameters;
  static const Table<P> table(
      "tearing",
      "A herschel-bulkley material may tear with the solver \"mpm\": where its accumulated plasticity passes "
      "tear_threshold it is weak, carries no tension and stretches freely.",
      {optional<P>("tear_threshold", &P::tear_threshold, number_or_infinity("1", from_to(1e-6, 1e12)),
                   "sigma_T: a point is weak while |dev C^p|_F exceeds it; C^p is the plastic Cauchy-Green "
                   "tensor"),
       optional<P>("recovery_time", &P::recovery_time, number_or_infinity("s", from_to(1e-6, kForever)),
                   "eta_p: plastic stretches fade as lambda^exp(-t/eta_p); short: sticky, long: brittle; "
                   "without effect where nothing tears")});
  return table;
}

Codec<Material> material_codec() {
  Codec<Material> codec;
  codec.allowed = "an object, see material";
  codec.schema = {{"$ref", "#/$defs/material"}};
  codec.read = read_material;
  codec.write = [](const Material& m) {
    Object object;
    material().write_fields(m, object);
    Object parameters;
    model_of(m.law).write(m.law, parameters);
    for (auto& [key, value] : parameters)
      if (!m.phase || m.phase->curve_of(key) == nullptr) object.emplace_back(key, std::move(value));
    if (m.law.index() == default_model().start.index()) tearing().write_fields(m.tearing, object);
    return Value(std::move(object));
  };
  return codec;
}

Object material_schema() {
  Array any;
  for (const Model& model : models()) any.emplace_back(schema_of(model));
  return {{"oneOf", std::move(any)}};
}

}  // namespace lather::tables

namespace lather {

std::vector<Law> Material::laws() const {
  if (!phase || phase->by_concentration.empty()) return {law};
  descriptor::Reading reading;
  std::vector<Law> out(kConcentrationNodes + 1, law);
  for (int k = 0; k <= kConcentrationNodes; ++k) {
    const double c = static_cast<double>(k) / kConcentrationNodes;
    tables::model_of(law).read(tables::values_at(*phase, c), out[static_cast<std::size_t>(k)],
                               descriptor::Place(reading), true);
  }
  return out;
}

bool Material::takes_volume_correction() const {
  const std::vector<Law> all = laws();
  return std::all_of(all.begin(), all.end(), [](const Law& l) {
    const auto* grains = std::get_if<DruckerPragerParameters>(&l);
    return std::holds_alternative<LiquidParameters>(l) || (grains != nullptr && grains->cohesion == 0);
  });
}

}  // namespace lather
