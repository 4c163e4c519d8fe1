#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// The viscosity that the FLIP/PIC blend adds.
[[nodiscard]] std::vector<Finding> verify_blend_viscosity(int threads);

}  // namespace lather::study
