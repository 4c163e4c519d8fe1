#pragma once

// Velocity gradients, and the smooth velocity that a point's own is blended with. Compiled per kernel level.

#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// [velocity gradients] L_AB = sum_j d_B N_j(x_i) (u_j - u_i)_A [MLSRK eq. 18] and
/// u^h(x_i) - u_i = sum_j N_j(x_i) (u_j - u_i) [MLSRK eq. 12], of differences, which keep their digits where
/// all points fall together. Where the constant is regularised too, sum_j N_j = 1 - r_0 b_0 and not 1, and
/// what that takes from the sums of u_j themselves is added.
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void gradients(const mlsrk::ShapeConstants<Real>& constants, Real inverse_scale,
                                const mlsrk::Surroundings<Real>& around, const Real* own_shape,
                                const Real* velocity, Real* gradient, Real* smooth) {
  constexpr int N = B::kCount;
  constexpr int reals = ShapeRow<Real, Dim, B>::kReals;
  const Rows<Real> near = points_near<T, Dim, W, Dim, false>(around, velocity, mlsrk::kVelocityRows);
  Rows<Real> neighbours = list_of(near, 0, 1 + 2 * Dim);
  const Real* own = velocity + std::size_t{mlsrk::kVelocityRows} * kLanes * around.tile;
  Real sums[Dim * Dim + Dim][kLanes] = {};  // L a, then u^h - u
  for (int i = 0; i < around.count; ++i) {
    find_neighbours<T, Dim, W, Dim>(around, near, i, neighbours);
    const ShapeRow<Real, Dim, B> shape = {own_shape + i * reals};
    T parts[Dim * Dim + Dim];
    for (T& part : parts) part = T(Real(0));
    for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>) {
      T value;
      T slope[Dim];
      shape.functions(Encounter<T, Dim, B, W>::at(neighbours, k), value, slope);
      const T volume = load<T>(neighbours[Dim] + k);
      for (int a = 0; a < Dim; ++a) {
        const T difference = (load<T>(neighbours[Dim + 1 + a] + k) - own[a * kLanes + i]) * volume;
        for (int d = 0; d < Dim; ++d) parts[a * Dim + d] = parts[a * Dim + d] + slope[d] * difference;
        parts[Dim * Dim + a] = parts[Dim * Dim + a] + value * difference;
      }
    }
    put_sums(parts, sums, i);
  }
  const Real r = constants.constant_regularization;
  for (int i = 0; r != Real(0) && i < around.count; ++i) {
    const ShapeRow<Real, Dim, B> shape = {own_shape + i * reals};
    Real b[N];
    for (int k = 0; k < N; ++k) b[k] = shape.b()[k];
    for (int a = 0; a < Dim; ++a) {
      const Real u = own[a * kLanes + i];
      for (int d = 0; d < Dim; ++d) {
        Real slope[N];
        B::derivative(d, b, slope);
        sums[a * Dim + d][i] -= (shape.c(d)[0] + slope[0]) * u * r;
      }
      sums[Dim * Dim + a][i] -= b[0] * u * r;
    }
  }
  for (int i = 0; i < kLanes; ++i) {
    for (int c = 0; c < Dim * Dim; ++c) gradient[c * kLanes + i] = sums[c][i] * inverse_scale;
    for (int a = 0; a < Dim; ++a) smooth[a * kLanes + i] = sums[Dim * Dim + a][i];
  }
}

}  // namespace lather::LATHER_LEVEL
