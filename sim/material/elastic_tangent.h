#pragma once

// The second derivative of the elastic energy, for the semi-implicit step. Compiled per kernel level.
//
// Positions of the grid's nodes x_i move by du_i, which deforms a point further by f = I + A,
// A = sum du_i grad w_i^T (the points' weights stay those of the step, [Stomakhin et al. 2013, section 6]).
// With the energy E = sum V W(f F) its derivative is
//
//   dE/dx_i = sum V  (tau f^-T) grad w_i,      tau the Kirchhoff stress [Foam eq. 2] of the moved state,
//
// which at A = 0 is minus the grid's force. Its derivative once more, along A,
//
//   d(tau f^-T) = d tau - tau A^T,             d tau = kappa J^2 (tr A) I + mu dev(d be),
//   d be        = A be + be A^T - 2/3 (tr A) be   (the chain rule through [Foam eq. 13]),
//
// is the operator, symmetric because E is a potential. With A = D + W (symmetric, antisymmetric) and
// S = dev D it splits into
//
//   d tau - tau A^T = [ kappa J^2 (tr D) I + mu dev(S be + be S) ] + [ W tau - tau D ].
//
// The first bracket is symmetric by itself and its energy, kappa J^2 (tr D)^2 + 2 mu tr(S be S), is never
// negative: the stiffness of the material. The second is the change of force that turning and stretching a
// stressed body brings ("geometric"); it may have either sign.

#include "sim/material/herschel_bulkley.h"

namespace lather::LATHER_LEVEL {

/// S b + b S for symmetric S and b = I + B, with B given.
template <class T>
inline Sym3<T> anticommutator(const Sym3<T>& S, const Sym3<T>& B) {
  using Real = typename ScalarOf<T>::type;
  const Real two(2);
  const auto twice = [&](const T& s, const T& product) { return (s + product) * two; };
  return {twice(S.xx, S.xx * B.xx + S.xy * B.xy + S.xz * B.xz),
          twice(S.yy, S.xy * B.xy + S.yy * B.yy + S.yz * B.yz),
          twice(S.zz, S.xz * B.xz + S.yz * B.yz + S.zz * B.zz),
          S.xy * two + (S.xx * B.xy + S.xy * B.yy + S.xz * B.yz) + (B.xx * S.xy + B.xy * S.yy + B.xz * S.yz),
          S.xz * two + (S.xx * B.xz + S.xy * B.yz + S.xz * B.zz) + (B.xx * S.xz + B.xy * S.yz + B.xz * S.zz),
          S.yz * two + (S.xy * B.xz + S.yy * B.yz + S.yz * B.zz) + (B.xy * S.xz + B.yy * S.yz + B.yz * S.zz)};
}

/// kappa J^2 (tr D) I + mu dev(S be + be S), Pa: the part of the tangent that is never negative.
template <class T, class Real>
inline Sym3<T> material_tangent(const HerschelBulkleyState<T>& state, const Mat3<T>& A,
                                const HerschelBulkleyConstants<Real>& c) {
  const auto& m = A.m;
  const Real half(0.5);
  const Sym3<T> D = {m[0][0],
                     m[1][1],
                     m[2][2],
                     (m[0][1] + m[1][0]) * half,
                     (m[0][2] + m[2][0]) * half,
                     (m[1][2] + m[2][1]) * half};
  const T J = state.volume_change + Real(1);
  const Sym3<T> shear = deviator(anticommutator(deviator(D), state.strain));
  return add_isotropic(scale(shear, T(c.shear_modulus)), J * J * trace(D) * c.bulk_modulus);
}

/// W tau - tau D, Pa: the change of force as the stressed material turns and stretches; not symmetric.
template <class T>
inline Mat3<T> geometric_tangent(const Sym3<T>& tau, const Mat3<T>& A) {
  using Real = typename ScalarOf<T>::type;
  const T t[3][3] = {{tau.xx, tau.xy, tau.xz}, {tau.xy, tau.yy, tau.yz}, {tau.xz, tau.yz, tau.zz}};
  Mat3<T> G;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      T sum(Real(0));
      for (int k = 0; k < 3; ++k)
        sum += (A.m[a][k] - A.m[k][a]) * t[k][b] - t[a][k] * (A.m[k][b] + A.m[b][k]);
      G.m[a][b] = sum * Real(0.5);
    }
  return G;
}

}  // namespace lather::LATHER_LEVEL
