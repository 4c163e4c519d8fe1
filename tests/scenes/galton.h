#pragma once

#include <string>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// Area that the material of a 2D scene covers inside a box, m^2: where the sum of the points' cubic splines
/// is above half of what it is inside a full lattice.
[[nodiscard]] double covered_area(const Scene& scene, const Simulation& simulation, const Box3& within);

/// The area of the water in the tank at rest, mean over the last quarter of a second, over that of the first
/// frame and over what its own weight leaves of that.
[[nodiscard]] double area_kept(const std::string& size, const std::vector<Override>& overrides, int threads);

}  // namespace lather::testing_support
