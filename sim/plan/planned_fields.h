#pragma once

#include <vector>

#include "sim/plan/tile_layout.h"
#include "sim/scene/scene.h"

namespace lather {

/// The fields that some stage of this scene reads, and no others.
[[nodiscard]] std::vector<Field> planned_fields(const Scene& scene);

}  // namespace lather
