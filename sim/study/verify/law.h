#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// The law alone: its return mapping and its start-up of shear, each against another method.
[[nodiscard]] std::vector<Finding> verify_law(int threads);

}  // namespace lather::study
