#pragma once

// B-spline kernels of the grid [Foam E.1; quadratic: the usual one of the same family], on lanes or one
// point. Compiled per kernel level.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// Four weights and their derivatives per cell width, at the nodes base, base + 1, …, where base = cell +
/// first.
template <class T>
struct Weights1 {
  T w[4];
  T d[4];
};

// One weight is what the others leave of 1. Computed each for itself, their constants (1/6, 2/3) would round
// the sum off 1 by the same bit at every point, and momentum would drift by an epsilon per step instead of
// walking at random.

/// Cubic, at fraction f in [0, 1] of the cell: first = -1.
template <class T>
inline Weights1<T> cubic_weights(const T& f) {
  using R = typename ScalarOf<T>::type;
  const T g = T(R(1)) - f;
  Weights1<T> r;
  r.w[0] = g * g * g * R(1.0 / 6);
  r.w[1] = f * f * (f * R(0.5) - R(1)) + R(2.0 / 3);
  r.w[3] = f * f * f * R(1.0 / 6);
  r.w[2] = (T(R(1)) - r.w[1]) - (r.w[0] + r.w[3]);
  r.d[0] = g * g * R(-0.5);
  r.d[1] = f * (f * R(1.5) - R(2));
  r.d[3] = f * f * R(0.5);
  r.d[2] = T(R(0)) - r.d[1] - (r.d[0] + r.d[3]);
  return r;
}

/// Quadratic, at the signed distance u in [-1/2, 1/2] from the middle node of three: first = -1 below half a
/// cell (u = f), 0 above (u = f - 1). The fourth weight is zero.
template <class T>
inline Weights1<T> quadratic_weights(const T& u) {
  using R = typename ScalarOf<T>::type;
  const T a = T(R(0.5)) - u;
  const T b = u + R(0.5);
  const T zero(R(0));
  Weights1<T> r;
  r.w[0] = a * a * R(0.5);
  r.w[2] = b * b * R(0.5);
  r.w[1] = T(R(1)) - (r.w[0] + r.w[2]);
  r.w[3] = zero;
  r.d[0] = -a;
  r.d[1] = u * R(-2);
  r.d[2] = b;
  r.d[3] = zero;
  return r;
}

/// Second moment of a kernel, sum w (x_i - x)^2 in cell widths squared: D of APIC over h^2.
template <class R>
constexpr R kernel_moment(bool cubic) {
  return cubic ? R(1.0 / 3) : R(0.25);
}

}  // namespace lather::LATHER_LEVEL
