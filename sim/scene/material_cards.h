#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/material/herschel_bulkley_parameters.h"
#include "sim/material/tearing_parameters.h"

namespace lather {

/// A measured or published material, ready to be named in a scene.
struct MaterialCard {
  std::string name;
  std::string words;
  std::string source;
  HerschelBulkleyParameters parameters;
  TearingParameters tearing;
};

[[nodiscard]] const std::vector<MaterialCard>& all_material_cards();
/// Null where no card has that name.
[[nodiscard]] const MaterialCard* find_material_card(std::string_view name);

}  // namespace lather
