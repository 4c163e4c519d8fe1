#pragma once

#include "sim/math/vec.h"

namespace lather {

/// det(I + G) - 1, which keeps its digits for small G: the trace, the sum of the principal minors of order
/// two, and det G.
[[nodiscard]] inline double determinant_change(const Mat3& G) {
  const double minors = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0) + G(1, 1) * G(2, 2) - G(1, 2) * G(2, 1) +
                        G(0, 0) * G(2, 2) - G(0, 2) * G(2, 0);
  return G.trace() + minors + G.determinant();
}

}  // namespace lather
