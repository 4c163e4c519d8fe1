#pragma once

#include "sim/scene/descriptor.h"
#include "sim/scene/scene.h"

namespace lather {

/// What no single field can tell: names that must be unique or known.
void check_names(const Value& document, const Scene& scene, const descriptor::Place& root);

/// The grid, the frames and 2D scenes, once every field is good. Gives points_per_cell its default.
void check_whole(const Value& document, Scene& scene, const descriptor::Place& root);

}  // namespace lather
