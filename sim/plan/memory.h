#pragma once

#include <cstdint>

#include "sim/plan/plan.h"

namespace lather {

/// Upper end of what a run takes, bytes: points twice (sorting), what the solver keeps beside them, a frame
/// and its neighbour in the queue. The plan has its materials, points and scalars already.
[[nodiscard]] std::uint64_t expected_memory(const Plan& plan);

}  // namespace lather
