#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// A cylinder slumps under its weight until it is everywhere at or below yield.
[[nodiscard]] std::vector<Finding> verify_slump(int threads);
/// With a low yield stress it spreads to a thin puddle.
[[nodiscard]] std::vector<Finding> verify_spreading(int threads);

}  // namespace lather::study
