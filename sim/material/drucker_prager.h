#pragma once

// Plastic flow of grains, powders and (without friction) fluids: the cone of Drucker and Prager with cohesion
// and a correction of volume [MLSRK section 4.3.4; Klar et al. 2016; Tampubolon et al. 2017]. The elastic
// stress is the neo-Hookean one times hardening(). Compiled per kernel level. d = Dim throughout.
//
//   F_e <- J_p^(1/d) F_e, J_p <- 1       volume lost in tension comes back before it may bear pressure
//   eps = log(S) - eps_c I               [MLSRK eq. 27], F_e = U S V^T
//   delta = |dev eps| + alpha (d lambda + 2 mu)/(2 mu) tr eps            [MLSRK eq. 28]
//
//   tr eps > 0:               H = 0: no stress but cohesion's, the opened volume goes to J_p
//   tr eps <= 0, delta > 0:   H = eps - delta dev eps/|dev eps|: slides at constant volume
//   else:                     H = eps: elastic, also without deviator
//
// S~ = exp(H + eps_c I). The paper tests the trace of the deviator, which is always 0; that of eps is meant.

#include "sim/material/drucker_prager_constants.h"
#include "sim/material/elastoplastic.h"
#include "sim/math/stretches.h"

namespace lather::LATHER_LEVEL {

/// Plastic correction after the elastic step. In 2D the two stretches in the plane are mapped.
template <int Dim, class T, class Real>
inline void correct_plastic(ElastoplasticState<T>& state, const DruckerPragerConstants<Real>& c) {
  const T zero(Real(0));
  const T one(Real(1));
  const Stretches<T> s = stretches(state.deformation);
  const T restored = log1p(state.plastic_volume) * Real(1.0 / Dim);  // per stretch, in the logarithm
  T log_J = zero;                                                    // of F_e as given
  for (int k = 0; k < Dim; ++k) log_J = log_J + s.log[k];
  const T mean = log_J * Real(1.0 / Dim);
  const T trace = log_J + (restored - T(c.cohesion)) * Real(Dim);
  T deviator[3];
  T squared = zero;
  for (int k = 0; k < Dim; ++k) {
    deviator[k] = s.log[k] - mean;
    squared = squared + deviator[k] * deviator[k];
  }
  const T norm = sqrt(squared);
  const T delta = norm + trace * c.slope;
  const auto opens = trace > zero;
  const auto slides = delta > zero;  // where it does not open, only with norm > 0
  const auto deviates = norm > zero;
  const T lost = select(slides & deviates, delta / select(deviates, norm, one), zero);  // of the deviator
  T change[3] = {zero, zero, zero};
  for (int k = 0; k < Dim; ++k)
    change[k] = select(opens, T(c.cohesion) - s.log[k], restored - deviator[k] * lost);
  state.deformation = stretched(state.deformation, s, change);
  state.plastic_volume = select(opens, expm1(trace), zero);
}

}  // namespace lather::LATHER_LEVEL
