#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// The area of the water in the tank at rest, mean over the last quarter of a second, over that of the first
/// frame and over what its own weight leaves of that.
[[nodiscard]] double area_kept(const std::string& size, const std::vector<Override>& overrides, int threads);

}  // namespace lather::testing_support
