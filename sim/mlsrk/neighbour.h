#pragma once

// How points meet their neighbours: one point 16 of them, or the 16 points of a tile one. Compiled per kernel
// level.

#include "sim/math/total.h"
#include "sim/mlsrk/basis.h"
#include "sim/mlsrk/kernels.h"
#include "sim/mlsrk/nearby.h"
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

/// The points of a tile that make a T.
template <class T, int Dim>
struct Target {
  T x[Dim];
  T volume;

  template <class Real>
  static Target load(const mlsrk::Surroundings<Real>& around, int lane) {
    const Real* place = around.place + std::size_t{4} * kLanes * around.tile;
    Target t;
    for (int a = 0; a < Dim; ++a) t.x[a] = Points<T>::load(place + a * kLanes, lane);
    t.volume = Points<T>::load(place + 3 * kLanes, lane);
    return t;
  }
};

/// Basis and kernel at an offset.
template <class T, int Dim, class B, class W>
struct Encounter {
  T h[B::kCount];
  Weight<T, Dim> phi;

  static Encounter at(const T (&xi)[Dim]) {
    Encounter e;
    B::evaluate(xi, e.h);
    e.phi = W::at(xi);
    return e;
  }
  /// The entries from `k` on of a list of neighbours: functions are centred on the point that has them.
  template <class Real>
  static Encounter at(const Rows<Real>& neighbours, std::int32_t k) {
    T xi[Dim];
    for (int a = 0; a < Dim; ++a) xi[a] = lather::LATHER_LEVEL::load<T>(neighbours[a] + k);
    return at(xi);
  }
  /// Functions centred on point `j` of those near the targets.
  template <class Real>
  static Encounter from(const Rows<Real>& near, std::int32_t j, const Target<T, Dim>& target) {
    T xi[Dim];
    for (int a = 0; a < Dim; ++a) xi[a] = target.x[a] - near[a][j];
    return at(xi);
  }
};

/// sum_k w_k h_k, with w_k plain reals or lanes.
template <class T, class V, int N>
inline T dot(const V* w, const T (&h)[N]) {
  T sum = T(w[0]);  // h_0 = 1
  for (int k = 1; k < N; ++k) sum = sum + h[k] * w[k];
  return sum;
}

/// The shape row of one point, and its neighbours' shape functions there.
template <class Real, int Dim, class B>
struct ShapeRow {
  static constexpr int kReals = B::kCount * (1 + Dim);
  const Real* row;

  [[nodiscard]] const Real* b() const { return row; }
  [[nodiscard]] const Real* c(int axis) const { return row + (1 + axis) * B::kCount; }

  /// N_j and a d_A N_j, over V_j.
  template <class T, class W>
  void functions(const Encounter<T, Dim, B, W>& e, T& value, T (&slope)[Dim]) const {
    const T corrected = dot(b(), e.h);
    value = corrected * e.phi.value;
    for (int a = 0; a < Dim; ++a) slope[a] = dot(c(a), e.h) * e.phi.value - corrected * e.phi.gradient[a];
  }
};

/// The totals of one point of a tile, in its column of [..][16].
template <class T, int K, class Real>
inline void put_sums(const T (&parts)[K], Real (*sums)[kLanes], int point) {
  for (int k = 0; k < K; ++k) sums[k][point] = total(parts[k]);
}

}  // namespace lather::LATHER_LEVEL
