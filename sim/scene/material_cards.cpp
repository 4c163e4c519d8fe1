#include "sim/scene/material_cards.h"

#include "sim/scene/tables.h"

namespace lather {
namespace {

constexpr const char* kFoamPaper = "Yue et al., \"Continuum Foam\", Table I";

}  // namespace

const std::vector<MaterialCard>& all_material_cards() {
  // Columns as printed, in SI units: density, bulk and shear modulus, yield stress, viscosity (Pa s^h), flow
  // index h; tear threshold and recovery time.
  static const std::vector<MaterialCard> cards = {
      {"shaving-cream",
       "shaving foam: soft, thins strongly under shear",
       kFoamPaper,
       {77.7, 109.0e3, 0.29e3, 31.9, 27.2, 0.22},
       {217.5, 0.35}},
      {"smore-interior",
       "molten marshmallow, the inside of a toasted one",
       kFoamPaper,
       {50.0, 109.0e3, 0.08e3, 10.0, 16.0, 0.43},
       {15.0, 0.25}},
      {"smore-exterior",
       "the stiff skin of a toasted marshmallow",
       kFoamPaper,
       {50.0, 109.0e3, 50.00e3, 1000.0, 0.1, 1.00},
       {0.3, 0.50}},
      {"pie", "cream pie filling", kFoamPaper, {275.0, 109.0e3, 1.60e3, 120.0, 5.0, 0.27}, {10.0, 0.30}},
      {"oobleck",
       "corn starch in water: thickens under shear",
       kFoamPaper,
       {1000.0, 109.0e3, 11.20e3, 0.1, 10.0, 2.80},
       {1.0, 0.30}},
      {"viscoplastic",
       "a Bingham fluid beside the oobleck, else alike",
       kFoamPaper,
       {1000.0, 109.0e3, 11.20e3, 0.1, 10.0, 1.00},
       {1.0, 0.30}},
  };
  return cards;
}

const MaterialCard* find_material_card(std::string_view name) {
  for (const MaterialCard& card : all_material_cards()) {
    if (card.name == name) return &card;
  }
  return nullptr;
}

std::string material_cards() {
  Array cards;
  for (const MaterialCard& card : all_material_cards()) {
    Object object = {
        {"name", card.name}, {"words", card.words}, {"source", card.source}, {"model", "herschel-bulkley"}};
    tables::herschel_bulkley().write_fields(card.parameters, object);
    tables::tearing().write_fields(card.tearing, object);
    cards.emplace_back(std::move(object));
  }
  return write_json(cards, 2);
}

}  // namespace lather
