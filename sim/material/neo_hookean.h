#pragma once

// The neo-Hookean solid of [MLSRK section 4.3.2] ("A Moving Least Square Reproducing Kernel Particle Method
// for Unified Multiphase Continuum Simulation"), on lanes of material points or on one point. Compiled per
// kernel level.
//
//   Psi   = mu/2 tr(F F^T - I) - mu log J + lambda/2 log^2 J             [MLSRK eq. 20]
//   J sigma = mu (F F^T - I) + lambda log J I                            [MLSRK eq. 22]
//
// The state is G = F - I (of the elastic part F_e, where a material yields), from which F F^T - I and J - 1
// come without cancellation: a strain of 1e-6 keeps its digits in float. In 2D G has no z parts, I is the
// identity of three dimensions: plane strain. det(I + G) > 0.

#include "sim/material/neo_hookean_constants.h"
#include "sim/math/exp_beyond_linear.h"
#include "sim/math/stretches.h"

namespace lather::LATHER_LEVEL {

/// Kirchhoff stress J sigma, Pa. [MLSRK eq. 22]
template <class T, class Real>
inline Sym3<T> kirchhoff_stress(const Mat3<T>& G, const NeoHookeanConstants<Real>& c) {
  const T log_J = log1p(det_minus_one(G));
  return add_isotropic(scale(left_cauchy_green_minus_identity(G), T(c.lame_mu)), log_J * c.lame_lambda);
}

/// Energy per volume at rest, Pa. [MLSRK eq. 20] By principal stretches, whose sum is log J:
/// mu/2 sum_k (exp(2 eps_k) - 1 - 2 eps_k) + lambda/2 (sum_k eps_k)^2.
template <class T, class Real>
inline T energy_density(const Mat3<T>& G, const NeoHookeanConstants<Real>& c) {
  const Stretches<T> s = stretches(G);
  const T log_J = s.log[0] + s.log[1] + s.log[2];
  const T shape = exp_beyond_linear(s.log[0] * Real(2)) + exp_beyond_linear(s.log[1] * Real(2)) +
                  exp_beyond_linear(s.log[2] * Real(2));
  return (shape * c.lame_mu + log_J * log_J * c.lame_lambda) * Real(0.5);
}

}  // namespace lather::LATHER_LEVEL
