#pragma once

// Forces between points, and the velocities they make. Compiled per kernel level.

#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// Index within a stress row of the component (a, b).
constexpr int stress_component(int a, int b) {
  return a == b ? a : 2 + a + b;
}

/// [momentum] u_i += dt (f_i / m + g), with f_i = -sum_j grad N_i(x_j) . sigma_j V_j and the lumped mass
/// m = sum_j N_i(x_j) m_j [MLSRK eq. 11]. N_i(x_j) is made with the corrections of j.
///
/// Of j this takes b, c and sigma, more than could be packed for each i: here the lanes are the tile's
/// points, which meet everything near the tile.
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void momentum(const mlsrk::MomentumStep<Real>& step, const mlsrk::Surroundings<Real>& around,
                               const Real* shape, const Real* stress, Real* velocity, Real* lumped_mass) {
  const Rows<Real> near = points_near<T, Dim, W, 0, true>(around);
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(around, lane);
    T sum[Dim];  // sum_j sigma_j V_j grad N_i(x_j), over V_i/a
    for (T& s : sum) s = T(Real(0));
    T lumped(Real(0));
    for (std::int32_t j = 0; j < near.count; ++j) {
      const std::size_t slot = around.slots[j];
      const ShapeRow<Real, Dim, B> at_j = {shape + slot * ShapeRow<Real, Dim, B>::kReals};
      const Real* S = stress + slot * mlsrk::kStressReals;
      T value;
      T slope[Dim];
      at_j.functions(Encounter<T, Dim, B, W>::from(near, j, target), value, slope);
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) sum[a] = sum[a] + slope[b] * S[stress_component(a, b)];
      lumped = lumped + value * S[mlsrk::kStressReals - 1];
    }
    lumped = lumped * target.volume;
    const T own = Points<T>::load(velocity + 3 * kLanes, lane);
    Points<T>::store(lumped, lumped_mass, lane);
    const T mass = step.own_mass ? own : select(lumped >= own * Real(mlsrk::kLightest), lumped, own);
    const T per_mass = target.volume * Real(-step.dt * step.inverse_scale) / mass;
    for (int a = 0; a < Dim; ++a) {
      Real* u = velocity + a * kLanes;
      Points<T>::store(Points<T>::load(u, lane) + (sum[a] * per_mass + Real(step.dt * step.gravity[a])), u,
                       lane);
    }
  }
}

}  // namespace lather::LATHER_LEVEL
