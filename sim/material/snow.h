#pragma once

// Plastic flow of snow (Stomakhin et al. 2013) as [MLSRK section 4.3.4] takes it: principal stretches of F_e
// stay in [1 - theta_c, 1 + theta_s], what is beyond goes to F_p. The elastic stress is the neo-Hookean one
// times hardening(). Compiled per kernel level.

#include "sim/material/elastoplastic.h"
#include "sim/material/snow_constants.h"
#include "sim/math/stretches.h"

namespace lather::LATHER_LEVEL {

/// Plastic correction after the elastic step. In 2D the two stretches in the plane are clamped.
template <int Dim, class T, class Real>
inline void correct_plastic(ElastoplasticState<T>& state, const SnowConstants<Real>& c) {
  const Stretches<T> s = stretches(state.deformation);
  T change[3] = {T(Real(0)), T(Real(0)), T(Real(0))};
  T taken(Real(0));  // log of the volume ratio that goes to F_p
  for (int k = 0; k < Dim; ++k) {
    const T missing = max(T(c.least_log_stretch) - s.log[k], T(Real(0)));
    change[k] = missing - max(s.log[k] - T(c.largest_log_stretch), T(Real(0)));
    taken = taken - change[k];
  }
  state.deformation = stretched(state.deformation, s, change);
  const T factor_minus_one = expm1(taken);
  state.plastic_volume = state.plastic_volume + factor_minus_one + state.plastic_volume * factor_minus_one;
}

}  // namespace lather::LATHER_LEVEL
