#pragma once

// How a point, or the 16 points of a tile, meets one neighbour. Compiled per kernel level.

#include "sim/mlsrk/basis.h"
#include "sim/mlsrk/kernels.h"
#include "sim/mlsrk/weight.h"

namespace lather::LATHER_LEVEL {

/// A lane's, or one point's, entry of [..][16] arrays and of rows.
template <class T>
struct Points;
template <class Real>
struct Points<Lane<Real>> {
  static constexpr int kPasses = 1;  ///< that a tile takes
  static Lane<Real> load(const Real* lanes, int) { return Lane<Real>::load(lanes); }
  static void store(const Lane<Real>& value, Real* lanes, int) { value.store(lanes); }
  /// Entry `k` of 16 rows of `reals`.
  static Lane<Real> load_row(const Real* rows, int reals, int k, int) {
    Real lanes[kLanes];
    for (int i = 0; i < kLanes; ++i) lanes[i] = rows[i * reals + k];
    return Lane<Real>::load(lanes);
  }
  static void store_row(const Lane<Real>& value, Real* rows, int reals, int k, int) {
    Real lanes[kLanes];
    value.store(lanes);
    for (int i = 0; i < kLanes; ++i) rows[i * reals + k] = lanes[i];
  }
};
template <class Real>
struct ScalarPoints {
  static constexpr int kPasses = kLanes;
  static Real load(const Real* lanes, int lane) { return lanes[lane]; }
  static void store(Real value, Real* lanes, int lane) { lanes[lane] = value; }
  static Real load_row(const Real* rows, int reals, int k, int lane) { return rows[lane * reals + k]; }
  static void store_row(Real value, Real* rows, int reals, int k, int lane) {
    rows[lane * reals + k] = value;
  }
};
template <>
struct Points<float> : ScalarPoints<float> {};
template <>
struct Points<double> : ScalarPoints<double> {};

/// Where targets stand, in units of a.
template <class T, int Dim>
struct Target {
  T x[Dim];
  T volume;  ///< over a^Dim

  template <class Real>
  static Target load(const mlsrk::Targets<Real>& from, int lane) {
    Target t;
    for (int a = 0; a < Dim; ++a) t.x[a] = Points<T>::load(from.place + a * kLanes, lane);
    t.volume = Points<T>::load(from.place + 3 * kLanes, lane);
    return t;
  }
};

/// Basis and kernel at the offset between a target and a neighbour.
template <class T, int Dim, class B, class W>
struct Encounter {
  T h[B::kCount];
  Weight<T, Dim> phi;

  /// At sign (x_j - x_i)/a: +1 for functions centred on the target i, -1 for those centred on the neighbour
  /// j.
  template <int Sign, class Real>
  static Encounter at(const Target<T, Dim>& target, const Real* neighbour) {
    T xi[Dim];
    for (int a = 0; a < Dim; ++a)
      xi[a] = Sign > 0 ? T(neighbour[a]) - target.x[a] : target.x[a] - T(neighbour[a]);
    Encounter e;
    B::evaluate(xi, e.h);
    e.phi = W::at(xi);
    return e;
  }
};

/// sum_k w_k h_k, with w_k plain reals or lanes.
template <class T, class V, int N>
inline T dot(const V* w, const T (&h)[N]) {
  T sum = T(w[0]);  // h_0 = 1
  for (int k = 1; k < N; ++k) sum = sum + h[k] * w[k];
  return sum;
}

}  // namespace lather::LATHER_LEVEL
