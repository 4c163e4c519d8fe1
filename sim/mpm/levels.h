#pragma once

#include "sim/mpm/kernels.h"
#include "sim/plan/plan.h"

namespace lather::mpm {

/// The kernels of a level. The machine must have it (machine_has); running others ends in an illegal
/// instruction.
template <class Real>
[[nodiscard]] const KernelTable<Real>& kernel_table(KernelLevel level);

}  // namespace lather::mpm
