#pragma once

// Newtonian viscosity [MLSRK section 4.3.3], beside any elastic stress. Compiled per kernel level.

#include "sim/material/newtonian_constants.h"
#include "sim/math/tensor.h"

namespace lather::LATHER_LEVEL {

/// Cauchy stress, Pa, of the velocity gradient L, 1/s:
///
///   sigma_v = mu_v [L + L^T - 2/d (tr L) I] + zeta_v (tr L) I            [MLSRK eq. 23], d = Dim
///
/// In 2D L has no z parts, I is the identity of the plane, and nothing acts across it.
template <int Dim, class T, class Real>
inline Sym3<T> viscous_stress(const Mat3<T>& L, const NewtonianConstants<Real>& c) {
  const auto& m = L.m;
  const T divergence = Dim == 3 ? m[0][0] + m[1][1] + m[2][2] : m[0][0] + m[1][1];
  const T isotropic = divergence * Real(c.bulk_viscosity - c.viscosity * Real(2.0 / Dim));
  const auto entry = [&](int i, int j) { return (m[i][j] + m[j][i]) * c.viscosity; };
  return {entry(0, 0) + isotropic,
          entry(1, 1) + isotropic,
          Dim == 3 ? entry(2, 2) + isotropic : T(Real(0)),
          entry(0, 1),
          entry(0, 2),
          entry(1, 2)};
}

}  // namespace lather::LATHER_LEVEL
