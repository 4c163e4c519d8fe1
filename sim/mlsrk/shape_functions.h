#pragma once

// Corrections of the shape functions and their gradients. Compiled per kernel level.

#include "sim/math/ldlt.h"
#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// b and c of a T's points, see kernels.h.
///
/// With R = diag(r_0, r, …, r) the regularisation, w = h(0) - R b, D_B the matrix that differentiates the
/// basis and P_B = sum_j h (b . h) d_B Phi V_j, Appendix A's chain for d_B b = -M^-1 (d_B M) b becomes
///
///   c_B = d_B b - D_B^T b = M^-1 (D_B w + P_B - R D_B^T b)      (all by xi, lengths over a)
///
/// so that neither d_B M nor a second matrix is ever formed.
template <class T, int Dim, class B>
struct Corrections {
  static constexpr int kTerms = B::kCount;
  using Real = typename ScalarOf<T>::type;

  Real r0;
  T r;
  Ldlt<T, kTerms> inverse;
  T b[kTerms];
  T fallen;  ///< 1 where M was singular

  /// Makes b of M without its regularisation, of which the lower triangle is read. Where M with it is
  /// singular, or so near to it that its inverse has no digits, it takes r = smallest_pivot, which brings
  /// every pivot there.
  void invert(const mlsrk::ShapeConstants<Real>& constants, T (&M)[kTerms][kTerms]) {
    r0 = constants.constant_regularization;
    r = T(constants.regularization);
    fallen = T(Real(0));
    M[0][0] = M[0][0] + r0;
    for (int k = 1; k < kTerms; ++k) M[k][k] = M[k][k] + r;
    inverse = factorize(M);
    if constexpr (kTerms > 1) {
      fallen = select(inverse.smallest_pivot >= T(constants.smallest_pivot), fallen, T(Real(1)));
      const T more = fallen * constants.smallest_pivot;
      for (int k = 1; k < kTerms; ++k) M[k][k] = M[k][k] + more;
      r = r + more;
      inverse = factorize(M);
    }
    for (T& entry : b) entry = T(Real(0));
    b[0] = T(Real(1));
    inverse.solve(b);
  }

  /// Makes c_B of P_B.
  void complete(int axis, T (&c)[kTerms]) const {
    T w[kTerms];  // h(0) - R b
    w[0] = T(Real(1)) - b[0] * r0;
    for (int k = 1; k < kTerms; ++k) w[k] = -r * b[k];
    T Dw[kTerms];
    T Db[kTerms];
    B::differentiate(axis, w, Dw);
    B::derivative(axis, b, Db);
    c[0] = c[0] + Dw[0] - Db[0] * r0;
    for (int k = 1; k < kTerms; ++k) c[k] = c[k] + Dw[k] - Db[k] * r;
    inverse.solve(c);
  }
};

/// The lower triangle of a symmetric matrix of size N, row by row.
template <int N>
inline constexpr int kTriangle = N*(N + 1) / 2;

/// M without its regularisation and, behind its triangle, sum_j Phi. Leaves V d_B Phi of the neighbours in
/// the list's rows behind their volumes.
template <class T, int Dim, class B, class W, class Real>
[[gnu::flatten]] inline void sum_moments(const Rows<Real>& neighbours, Real (*moments)[kLanes], int point) {
  constexpr int N = B::kCount;
  T sums[kTriangle<N> + 1];
  for (T& s : sums) s = T(Real(0));
  for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>) {
    const auto e = Encounter<T, Dim, B, W>::at(neighbours, k);
    const T volume = load<T>(neighbours[Dim] + k);
    for (int a = 0; a < Dim; ++a) store(e.phi.gradient[a] * volume, neighbours[Dim + 1 + a] + k);
    const T weight = e.phi.value * volume;
    int entry = 0;
    for (int m = 0; m < N; ++m) {
      const T hw = m == 0 ? weight : e.h[m] * weight;  // h_0 = 1
      for (int n = 0; n <= m; ++n, ++entry) sums[entry] = sums[entry] + (n == 0 ? hw : hw * e.h[n]);
    }
    sums[entry] = sums[entry] + e.phi.value;
  }
  put_sums(sums, moments, point);
}

/// P_B, after sum_moments().
template <class T, int Dim, class B, class Real>
[[gnu::flatten]] inline void sum_slopes(const Rows<Real>& neighbours, const Real (&b)[B::kCount],
                                        Real (*P)[kLanes], int point) {
  constexpr int N = B::kCount;
  T sums[Dim * N];
  for (T& s : sums) s = T(Real(0));
  for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>) {
    T xi[Dim];
    for (int a = 0; a < Dim; ++a) xi[a] = load<T>(neighbours[a] + k);
    T h[N];
    B::evaluate(xi, h);
    const T corrected = dot(b, h);
    for (int a = 0; a < Dim; ++a) {
      const T slope = corrected * load<T>(neighbours[Dim + 1 + a] + k);
      sums[a * N] = sums[a * N] + slope;
      for (int m = 1; m < N; ++m) sums[a * N + m] = sums[a * N + m] + h[m] * slope;
    }
  }
  put_sums(sums, P, point);
}

/// [shape functions]
template <class T, class Real, int Dim, class B, class W>
void shape_functions(const mlsrk::ShapeConstants<Real>& constants, const mlsrk::Surroundings<Real>& around,
                     Real* shape, Real* crowding, Real* fallen) {
  constexpr int N = B::kCount;
  constexpr int reals = ShapeRow<Real, Dim, B>::kReals;
  constexpr int kPasses = Points<T>::kPasses;
  const Rows<Real> near = points_near<T, Dim, W, 0, false>(around);
  Rows<Real> neighbours[kLanes];
  Real moments[kTriangle<N> + 1][kLanes] = {};
  for (int i = 0; i < around.count; ++i) {
    neighbours[i] = list_of(near, i, 1 + 2 * Dim);
    find_neighbours<T, Dim, W, 0>(around, near, i, neighbours[i]);
    sum_moments<T, Dim, B, W>(neighbours[i], moments, i);
  }
  for (int i = around.count; i < kLanes; ++i)
    moments[0][i] = Real(1);  // of an empty lane, to invert something
  for (int i = 0; i < kLanes; ++i) crowding[i] = moments[kTriangle<N>][i];

  Corrections<T, Dim, B> corrections[kPasses];
  Real b[N][kLanes];
  for (int lane = 0; lane < kPasses; ++lane) {
    T M[N][N];
    int entry = 0;
    for (int m = 0; m < N; ++m)
      for (int n = 0; n <= m; ++n) M[m][n] = Points<T>::load(moments[entry++], lane);
    corrections[lane].invert(constants, M);
    for (int k = 0; k < N; ++k) {
      Points<T>::store(corrections[lane].b[k], b[k], lane);
      Points<T>::store_row(corrections[lane].b[k], shape, reals, k, lane);
    }
    Points<T>::store(corrections[lane].fallen, fallen, lane);
  }

  Real P[Dim * N][kLanes] = {};
  for (int i = 0; i < around.count; ++i) {
    Real own[N];
    for (int k = 0; k < N; ++k) own[k] = b[k][i];
    sum_slopes<T, Dim, B>(neighbours[i], own, P, i);
  }
  for (int lane = 0; lane < kPasses; ++lane)
    for (int a = 0; a < Dim; ++a) {
      T c[N];
      for (int k = 0; k < N; ++k) c[k] = Points<T>::load(P[a * N + k], lane);
      corrections[lane].complete(a, c);
      for (int k = 0; k < N; ++k) Points<T>::store_row(c[k], shape, reals, N + a * N + k, lane);
    }
}

}  // namespace lather::LATHER_LEVEL
