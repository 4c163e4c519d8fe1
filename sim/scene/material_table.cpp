#include "sim/scene/material_cards.h"
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

bool read_material(const Value& value, Material& out, const Place& place) {
  if (value.object() == nullptr) return place.refuse(value, "an object", "A material must be an object.");
  std::vector<std::string> known = material().names();
  for (const std::string& name : herschel_bulkley().names()) known.push_back(name);
  for (const std::string& name : tearing().names()) known.push_back(name);
  refuse_unknown_keys(*value.object(), known, place);
  bool good = material().read_fields(value, out, place);
  const MaterialCard* card = find_material_card(out.preset);
  out.herschel_bulkley = card != nullptr ? card->parameters : herschel_bulkley().prototype();
  out.tearing = card != nullptr ? card->tearing : tearing().prototype();
  good = tearing().read_fields(value, out.tearing, place) && good;
  const bool complete = value.find("preset") != nullptr;
  return herschel_bulkley().read_fields(value, out.herschel_bulkley, place, complete) && good;
}

}  // namespace

const Table<Material>& material() {
  static const Table<Material> table(
      "material",
      "What a body is made of: a card by name, parameters, or a card with some parameters replaced.",
      {required<Material>("name", &Material::name, text(1, 64), "by which bodies refer to it"),
       optional<Material>("model", &Material::model, one_of({"herschel-bulkley"}), "the constitutive law"),
       preset_field()});
  return table;
}

const Table<HerschelBulkleyParameters>& herschel_bulkley() {
  using P = HerschelBulkleyParameters;
  P elastic;
  elastic.yield_stress = kInfinity;
  static const Table<P> table(
      "herschel-bulkley",
      "Elasto-viscoplastic foam. Perfectly plastic with viscosity 0, Bingham with flow_index 1, elastic with "
      "an "
      "infinite yield_stress. The first three keys are required where no preset is named.",
      {required<P>("density", &P::density, number("kg/m^3", from_to(1e-3, 1e5)), "mass per volume at rest"),
       required<P>("bulk_modulus", &P::bulk_modulus, number("Pa", from_to(1e-3, 1e13)),
                   "stiffness against change of volume"),
       required<P>("shear_modulus", &P::shear_modulus, number("Pa", from_to(1e-6, 1e13)),
                   "stiffness against change of form"),
       optional<P>("yield_stress", &P::yield_stress, number_or_infinity("Pa", from_to(0, 1e13)),
                   "sigma_Y: plastic flow starts where the shear stress norm reaches sqrt(2/3) of it"),
       optional<P>("viscosity", &P::viscosity, number("Pa s^h", from_to(0, 1e9)),
                   "eta: resistance of the plastic flow; h is the flow_index"),
       optional<P>("flow_index", &P::flow_index, number("1", from_to(0.05, 10)),
                   "h: below 1 the material thins under shear, above 1 it thickens")},
      elastic);
  return table;
}

const Table<TearingParameters>& tearing() {
  using P = TearingParameters;
  static const Table<P> table(
      "tearing",
      "Any material may tear: where its accumulated plasticity passes tear_threshold it is weak, carries no "
      "tension and stretches freely.",
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
    herschel_bulkley().write_fields(m.herschel_bulkley, object);
    tearing().write_fields(m.tearing, object);
    return Value(std::move(object));
  };
  return codec;
}

Object material_schema() {
  Array parameters;
  std::vector<FieldInfo> fields = herschel_bulkley().info().fields;
  for (FieldInfo& field : fields) {
    if (field.presence == Presence::kRequired) parameters.emplace_back(field.name);
    field.presence = Presence::kOptional;
  }
  for (const FieldInfo& field : tearing().info().fields) fields.push_back(field);
  Object schema = object_schema(material().info(), fields);
  schema.emplace_back("anyOf",
                      Array{Object{{"required", Array{"preset"}}}, Object{{"required", parameters}}});
  return schema;
}

}  // namespace lather::tables
