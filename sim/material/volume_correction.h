#pragma once

// Correction of the volume that a deformation has drifted to [MLSRK section 4.3.1]: neighbours tell a point's
// volume V, which errs but does not drift. Compiled per kernel level.

#include "sim/math/tensor.h"

namespace lather::LATHER_LEVEL {

/// V/V0 - 1 with all digits of a small change. It is J~ - 1 of a liquid, whose state is J - 1 alone.
/// [MLSRK eq. 19]
template <class T>
inline T corrected_volume_change(const T& volume, const T& rest_volume) {
  return (volume - rest_volume) / rest_volume;
}

/// exp(log_ratio / d) F - I of G = F - I, d = Dim: its volume grows by exp(log_ratio). In 2D the stretch
/// across the plane stays.
template <int Dim, class T>
inline Mat3<T> grown(const Mat3<T>& G, const T& log_ratio) {
  using Real = typename ScalarOf<T>::type;
  const T grow = expm1(log_ratio * Real(1.0 / Dim));
  Mat3<T> r = G;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < Dim; ++j) {
      const T gain = G.m[i][j] * grow;
      r.m[i][j] = G.m[i][j] + (i == j ? gain + grow : gain);
    }
  return r;
}

/// F~ - I with F~ = (V/(V0 J))^(1/d) F [MLSRK eq. 19], d = Dim; `volume_change` = V/V0 - 1. Of a law with
/// F = F_e F_p, G is F_e - I and J = J_e J_p: the factor goes to F_e, J_p = 1 + plastic_volume stays. In 2D
/// the stretch across the plane stays 1. J > 0 and V > 0.
template <int Dim, class T>
inline Mat3<T> volume_corrected(const Mat3<T>& G, const T& volume_change, const T& plastic_volume) {
  return grown<Dim>(G, log1p(volume_change) - (log1p(det_minus_one(G)) + log1p(plastic_volume)));
}
template <int Dim, class T>
inline Mat3<T> volume_corrected(const Mat3<T>& G, const T& volume_change) {
  using Real = typename ScalarOf<T>::type;
  return volume_corrected<Dim>(G, volume_change, T(Real(0)));
}

}  // namespace lather::LATHER_LEVEL
