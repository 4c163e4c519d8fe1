#pragma once

#include <memory>

#include "sim/simulation.h"

namespace lather::mpm {

/// A Simulation by the Material Point Method, in the precision that the plan's scene asks for.
[[nodiscard]] std::unique_ptr<Simulation> create_simulation(const Plan& plan, int threads);

}  // namespace lather::mpm
