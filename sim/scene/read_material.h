#pragma once

#include <string_view>

#include "sim/scene/scene.h"

namespace lather {

/// Reads one material as a scene holds it; its name may be left out. Throws InputError with all problems
/// found.
[[nodiscard]] Material parse_material(std::string_view json);

/// The material of a card ("shaving-cream", …). Throws InputError, with the names there are, for another
/// name.
[[nodiscard]] Material material_from_card(std::string_view name);

}  // namespace lather
