#pragma once

#include <memory>

#include "sim/simulation.h"

namespace lather::mlsrk {

/// A Simulation by moving-least-squares reproducing kernels, in the precision that the plan's scene asks for.
[[nodiscard]] std::unique_ptr<Simulation> create_simulation(const Plan& plan, int threads);

}  // namespace lather::mlsrk
