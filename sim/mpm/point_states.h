#pragma once

#include <functional>

#include "sim/mpm/step.h"
#include "sim/simulation.h"

namespace lather::mpm {

/// Calls visit() for every point, material by material, as the points lie in memory.
template <class Real>
void visit_states(const State<Real>& state, const Model<Real>& model, const PointKernels<Real>& kernels,
                  const std::function<void(const PointState&)>& visit);

}  // namespace lather::mpm
