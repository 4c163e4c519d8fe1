#pragma once

#include "sim/material/law_constants.h"
#include "sim/scene/scene.h"

namespace lather {

/// A law's parameters as the kernels of either solver read them, in 2 or 3 dimensions; `swelling` is 1.
template <class Real>
[[nodiscard]] LawConstants<Real> law_constants(const Law& law, int dimension);

}  // namespace lather
