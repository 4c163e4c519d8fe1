#pragma once

#include "sim/simulation.h"

namespace lather::testing_support {

/// Of the domain, m^2 (its width, m, in 2D).
[[nodiscard]] double floor_area(const Scene& scene);

/// Volume (area in 2D) that the material covers in a tank whose floor and sides are walls, m^3: where the sum
/// of the cubic splines of the points and of their mirror images in those walls is above half of what it is
/// inside a full lattice.
[[nodiscard]] double covered_volume(const Scene& scene, const Simulation& simulation, const Box3& tank);

/// By how much its own weight presses a liquid that lies `depth` (m) deep together, on the mean; its law is
/// the scene's first material, of Drucker and Prager.
[[nodiscard]] double compression_under_weight(const Scene& scene, double depth);

}  // namespace lather::testing_support
