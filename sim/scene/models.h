#pragma once

#include "sim/scene/scene.h"
#include "sim/scene/tagged.h"

/// The constitutive laws by the names that a material's key "model" gives them.
namespace lather::tables {

/// A law as a material holds its parameters, among the material's own keys.
struct Model {
  std::string name;
  descriptor::TableInfo info;
  Law start;  ///< with the defaults
  /// With `complete` nothing need be given: the law holds values already.
  std::function<bool(const Value&, Law&, const descriptor::Place&, bool complete)> read;
  std::function<void(const Law&, Object&)> write;
};

/// One for each alternative of Law, in their order.
[[nodiscard]] const std::vector<Model>& models();
[[nodiscard]] const Model& model_of(const Law& law);
/// Where a scene names no model.
[[nodiscard]] const Model& default_model();

[[nodiscard]] const descriptor::Table<HerschelBulkleyParameters>& herschel_bulkley();
[[nodiscard]] const descriptor::Table<NeoHookeanParameters>& neo_hookean();
[[nodiscard]] const descriptor::Table<DruckerPragerParameters>& drucker_prager();
[[nodiscard]] const descriptor::Table<SnowParameters>& snow();
[[nodiscard]] const descriptor::Table<LiquidParameters>& liquid();

}  // namespace lather::tables
