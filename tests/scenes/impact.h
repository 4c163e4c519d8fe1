#pragma once

#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::testing_support {

/// A body dropped on the ground, a plane that is the scene's first obstacle.
struct Impact {
  double drop_height = 0;   ///< m, of a free fall from rest that lands as fast as the scene's body
  double climb = 0;         ///< m, the highest that the centre of mass climbs from a lower place before
  double lift = 0;          ///< m, height above the ground of the lowest point, its largest after landing
  double final_height = 0;  ///< m, of the highest point above the ground at the end
  double body_height = 0;   ///< m, of the body at the start
};

[[nodiscard]] Impact measure_impact(const Scene& scene, const Report& report);

/// Prints the figures beside `name`, a line.
void print(const std::string& name, const Impact& impact);

}  // namespace lather::testing_support
