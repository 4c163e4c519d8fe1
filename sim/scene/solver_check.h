#pragma once

#include "sim/scene/descriptor.h"
#include "sim/scene/scene.h"

namespace lather {

/// What the scene's solver does not do. Every field is good, and points_per_cell has its value.
void check_solver(const Value& document, const Scene& scene, const descriptor::Place& root);

}  // namespace lather
