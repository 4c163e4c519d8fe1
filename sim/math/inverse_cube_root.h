#pragma once

// (1 + d)^(-1/3) on lanes or a plain real. Compiled per kernel level.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// y (1 - r)^(-1/3), r = 1 - x y^3, to the third order in r: one step towards x^(-1/3).
template <class T>
inline T step_to_inverse_cube_root(const T& x, const T& y) {
  using Real = typename ScalarOf<T>::type;
  const T r = T(Real(1)) - x * y * y * y;
  return y + y * r * (Real(1.0 / 3) + r * (Real(2.0 / 9) + r * Real(14.0 / 81)));
}

/// (1 + d)^(-1/3), NaN where 1 + d <= 0. Changes of volume over a step are small, and the binomial series
/// polished once (a float) or twice has all digits up to |d| = 0.4; beyond, by logarithms.
template <class T>
inline T inverse_cube_root_of_one_plus(const T& d) {
  using Real = typename ScalarOf<T>::type;
  const T x = d + Real(1);
  T y = T(Real(1)) + d * (Real(-1.0 / 3) + d * (Real(2.0 / 9) + d * Real(-14.0 / 81)));
  y = step_to_inverse_cube_root(x, y);
  if constexpr (sizeof(Real) == 8) y = step_to_inverse_cube_root(x, y);
  const auto large = abs(d) > T(Real(0.4));
  if (any(large)) y = select(large, exp(log(x) * Real(-1.0 / 3)), y);
  return y;
}

}  // namespace lather::LATHER_LEVEL
