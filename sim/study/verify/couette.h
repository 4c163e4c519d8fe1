#pragma once

#include "sim/study/verify/case.h"

namespace lather::study {

/// Start-up of shear in the Maxwell limit: by the law alone, and by the whole method in a periodic box.
[[nodiscard]] std::vector<Finding> verify_couette(int threads);

}  // namespace lather::study
