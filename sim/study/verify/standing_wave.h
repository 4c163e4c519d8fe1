#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// Frequency and decay of an elastic standing wave.
[[nodiscard]] std::vector<Finding> verify_standing_wave(int threads);

}  // namespace lather::study
