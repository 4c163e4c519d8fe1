#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::testing_support {

/// Where thrown cream is, as shares of its points. A cluster (balls of half a spacing, see clusters.h) lies
/// on the floor if any of its points is within two spacings of it, as far as the cubic kernel carries
/// contact, else on the face if one is as near to that, else it floats.
struct Splat {
  double on_face = 0;
  double on_floor = 0;
  double floating = 0;
};

/// `scene` has the obstacles "face" and "ground", at rest.
[[nodiscard]] Splat find_splat(const Scene& scene, const Simulation& simulation);

/// One second after the throw at least three quarters of the cream are on the face, something has torn off
/// and fallen to the floor, and nothing floats.
void expect_cream_sticks_to_the_face(const std::string& size, const std::vector<Override>& overrides,
                                     int threads);

}  // namespace lather::testing_support
