#pragma once

#include <array>
#include <functional>

#include "sim/mpm/step.h"
#include "sim/simulation.h"

namespace lather::mpm {

/// Kirchhoff stress of every lane of a tile by its points' law, Pa: xx yy zz xy xz yz.
template <class Real>
[[nodiscard]] std::array<std::array<double, 6>, kTile> law_stress(const ParticleSet<Real>& set,
                                                                  const MaterialConstants<Real>& material,
                                                                  std::size_t tile);

/// Calls visit() for every point, material by material, as the points lie in memory.
template <class Real>
void visit_states(const State<Real>& state, const Model<Real>& model,
                  const std::function<void(const PointState&)>& visit);

}  // namespace lather::mpm
