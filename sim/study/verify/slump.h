#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// A cylinder slumps under its weight until it is everywhere at or below yield.
[[nodiscard]] std::vector<Finding> verify_slump(int threads);

}  // namespace lather::study
