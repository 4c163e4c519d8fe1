#pragma once

#include "sim/kernel_level.h"
#include "sim/mlsrk/kernels.h"

namespace lather::mlsrk {

/// The kernels of a level. The machine must have it (machine_has); running others ends in an illegal
/// instruction.
template <class Real>
[[nodiscard]] const KernelTable<Real>& kernel_table(KernelLevel level);

}  // namespace lather::mlsrk
