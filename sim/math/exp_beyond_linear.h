#pragma once

// Compiled per kernel level, like lane.h.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// exp(x) - 1 - x with all digits of a small x, for x above -80.
template <class T>
inline T exp_beyond_linear(const T& x) {
  using Real = typename ScalarOf<T>::type;
  constexpr Real kSmall = Real(0.125);
  constexpr int kTerms = 11;  // 0.125^10 2/12! is below a double's rounding
  T series(Real(1));          // x^2/2 (1 + x/3 (1 + x/4 (1 + …)))
  for (int n = kTerms; n > 2; --n) series = series * x * Real(1.0 / n) + Real(1);
  return select(abs(x) < T(kSmall), x * x * series * Real(0.5), expm1(x) - x);
}

}  // namespace lather::LATHER_LEVEL
