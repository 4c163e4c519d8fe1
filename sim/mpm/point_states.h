#pragma once

#include <array>
#include <functional>

#include "sim/mpm/step.h"
#include "sim/simulation.h"

namespace lather::mpm {

/// Kirchhoff stress of the point in a lane by its law, Pa: xx yy zz xy xz yz. [Foam eq. 2]
template <class Real>
[[nodiscard]] std::array<double, 6> law_stress(const ParticleSet<Real>& set,
                                               const MaterialConstants<Real>& material,
                                               const PointKernels<Real>& kernels, std::size_t tile, int lane);

/// Calls visit() for every point, material by material, as the points lie in memory.
template <class Real>
void visit_states(const State<Real>& state, const Model<Real>& model, const PointKernels<Real>& kernels,
                  const std::function<void(const PointState&)>& visit);

}  // namespace lather::mpm
