#pragma once

#include <string>
#include <vector>

#include "sim/plan/tile_layout.h"
#include "sim/scene/scene.h"

namespace lather {

/// The fields that some stage of this scene reads of this material's points, and no others.
[[nodiscard]] std::vector<Field> planned_fields(const Scene& scene, const Material& material);

/// The point scalars that every frame carries: the one that colours the picture, then those asked for in
/// files.
[[nodiscard]] std::vector<std::string> planned_scalars(const Scene& scene);

}  // namespace lather
