#pragma once

// Velocity gradients, and the smooth velocity that a point's own is blended with. Compiled per kernel level.

#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// [velocity gradients] L_AB = sum_j d_B N_j(x_i) (u_j - u_i)_A [MLSRK eq. 18] and
/// u^h(x_i) - u_i = sum_j N_j(x_i) (u_j - u_i) [MLSRK eq. 12], of differences, which keep their digits where
/// all points fall together. Where the constant is regularised too, sum_j N_j = 1 - r_0 b_0 and not 1, and
/// what that takes from the sums of u_j themselves is added.
template <class T, class Real, int Dim, class B, class W>
void gradients(const mlsrk::ShapeConstants<Real>& constants, Real inverse_scale,
               const mlsrk::Targets<Real>& targets, const mlsrk::Candidates<Real>& near,
               const Real* own_shape, const Real* own_velocity, const Real* velocity, Real* gradient,
               Real* smooth) {
  constexpr int N = B::kCount;
  constexpr int reals = N * (1 + Dim);
  const T zero(Real(0));
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    T b[N];
    T c[Dim][N];
    T u[Dim];
    for (int k = 0; k < N; ++k) b[k] = Points<T>::load_row(own_shape, reals, k, lane);
    for (int a = 0; a < Dim; ++a) {
      for (int k = 0; k < N; ++k) c[a][k] = Points<T>::load_row(own_shape, reals, N + a * N + k, lane);
      u[a] = Points<T>::load_row(own_velocity, mlsrk::kVelocityReals, a, lane);
    }
    T L[Dim][Dim];
    T du[Dim];
    for (int a = 0; a < Dim; ++a) {
      du[a] = zero;
      for (T& entry : L[a]) entry = zero;
    }
    for (std::int32_t j = 0; j < near.count; ++j) {
      const Real* p = near.place + 4 * j;
      const Real* uj = velocity + std::size_t{near.slot[j]} * mlsrk::kVelocityReals;
      const auto e = Encounter<T, Dim, B, W>::template at<1>(target, p);
      const T corrected = dot(b, e.h);
      const T shape = corrected * e.phi.value * p[3];
      T slope[Dim];
      for (int a = 0; a < Dim; ++a)
        slope[a] = (dot(c[a], e.h) * e.phi.value - corrected * e.phi.gradient[a]) * p[3];
      for (int a = 0; a < Dim; ++a) {
        const T difference = T(uj[a]) - u[a];
        du[a] = du[a] + shape * difference;
        for (int d = 0; d < Dim; ++d) L[a][d] = L[a][d] + slope[d] * difference;
      }
    }
    if (const Real r = constants.constant_regularization; r != Real(0))
      for (int a = 0; a < Dim; ++a) {
        du[a] = du[a] - b[0] * u[a] * r;
        for (int d = 0; d < Dim; ++d) {
          T slope[N];
          B::derivative(d, b, slope);
          L[a][d] = L[a][d] - (c[d][0] + slope[0]) * u[a] * r;
        }
      }
    for (int a = 0; a < Dim; ++a) {
      Points<T>::store(du[a], smooth + a * kLanes, lane);
      for (int d = 0; d < Dim; ++d)
        Points<T>::store(L[a][d] * inverse_scale, gradient + (a * Dim + d) * kLanes, lane);
    }
  }
}

}  // namespace lather::LATHER_LEVEL
