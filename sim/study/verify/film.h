#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// Herschel-Bulkley film on a slope, at three spacings, and one that must not flow.
[[nodiscard]] std::vector<Finding> verify_film(int threads);
/// The same velocity profile at finer spacings.
[[nodiscard]] std::vector<Finding> verify_fine_film(int threads);

}  // namespace lather::study
