#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// A block below yield keeps its form for tens of thousands of single-precision steps.
[[nodiscard]] std::vector<Finding> verify_resting_block(int threads);

}  // namespace lather::study
