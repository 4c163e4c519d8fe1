#include "sim/scene/read_material.h"

#include "sim/scene/material_cards.h"
#include "sim/scene/tables.h"

namespace lather {

using namespace descriptor;  // the vocabulary of tables

Material parse_material(std::string_view json) {
  Value document = parse_json(json);
  if (document.object() != nullptr && document.find("name") == nullptr)
    document.object()->emplace_back("name", "material");
  Reading reading;
  Material material;
  tables::material_codec().read(document, material, Place(reading));
  if (!reading.problems.empty()) throw InputError(std::move(reading.problems));
  return material;
}

Material material_from_card(std::string_view name) {
  const MaterialCard* card = find_material_card(name);
  if (card == nullptr) {
    std::vector<std::string> names;
    for (const MaterialCard& c : all_material_cards()) names.push_back(c.name);
    const std::string near = nearest_name(name, names);
    throw InputError(
        {{"", std::string(name), listed(names),
          "There is no preset of that name." + (near.empty() ? "" : " Did you mean \"" + near + "\"?")}});
  }
  Material material;
  material.name = card->name;
  material.preset = card->name;
  material.law = card->parameters;
  material.tearing = card->tearing;
  return material;
}

}  // namespace lather
