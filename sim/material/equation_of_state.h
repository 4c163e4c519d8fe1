#pragma once

// The weakly compressible liquid of [MLSRK Fig. 3] (WCSPH; Becker and Teschner 2007). Compiled per kernel
// level. The state is J - 1: at K = 2 GPa water under a metre of itself is compressed by 5e-6.
//
//   p = (K/gamma) (J^-gamma - 1), never below 0: it would pull at a free surface.

#include "sim/material/equation_of_state_constants.h"
#include "sim/math/exp_beyond_linear.h"

namespace lather::LATHER_LEVEL {

/// Pressure, Pa. The Cauchy stress is -p I, Kirchhoff's -J p I. J > 0: otherwise it is not a number.
template <class T, class Real>
inline T pressure(const T& volume_change, const EquationOfStateConstants<Real>& c) {
  const T p = expm1(log1p(volume_change) * Real(-c.exponent)) * Real(c.bulk_modulus / c.exponent);
  return select(p < T(Real(0)), T(Real(0)), p);
}

/// Energy per volume at rest, Pa: -dW/dJ = p, 0 where there is no pressure. With x = log J, a = 1 - gamma and
/// g(y) = exp(y) - 1 - y,
///
///   W = (K/gamma) [(1 - J^a)/a + J - 1] = (K/gamma) [g(x) - g(a x)/a].
template <class T, class Real>
inline T energy_density(const T& volume_change, const EquationOfStateConstants<Real>& c) {
  const T x = log1p(volume_change);
  const Real a = Real(1) - c.exponent;
  T w = exp_beyond_linear(x);
  if (a < Real(0)) w = w - exp_beyond_linear(x * a) / T(a);
  return select(volume_change > T(Real(0)), T(Real(0)), w * Real(c.bulk_modulus / c.exponent));
}

}  // namespace lather::LATHER_LEVEL
