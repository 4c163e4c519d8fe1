#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// A block on an incline: it slides as Coulomb says, or sticks.
[[nodiscard]] std::vector<Finding> verify_incline(int threads);

}  // namespace lather::study
