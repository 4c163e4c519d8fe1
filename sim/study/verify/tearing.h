#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// Tearing and recovery of single points against their closed forms, in both precisions.
[[nodiscard]] std::vector<Finding> verify_tearing(int threads);
/// The same in a sheared box of points, by the whole method.
[[nodiscard]] std::vector<Finding> verify_tearing_box(int threads);

}  // namespace lather::study
