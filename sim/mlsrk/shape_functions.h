#pragma once

// Corrections of the shape functions and their gradients. Compiled per kernel level.

#include "sim/math/ldlt.h"
#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// b and c of one point, see kernels.h.
///
/// With R = diag(r_0, r, …, r) the regularisation, w = h(0) - R b, D_B the matrix that differentiates the
/// basis and P_B = sum_j h (b . h) d_B Phi V_j, Appendix A's chain for d_B b = -M^-1 (d_B M) b becomes
///
///   c_B = d_B b - D_B^T b = M^-1 (D_B w + P_B - R D_B^T b)      (all by xi, lengths over a)
///
/// so that neither d_B M nor a second matrix is ever formed.
template <class T, int Dim, class B>
struct Shape {
  T b[B::kCount];
  T c[Dim][B::kCount];
  T crowding;  ///< sum_j Phi, dimensionless
  T fallen;    ///< 1 where M was singular
};

/// M without its regularisation: the lower triangle.
template <class T, int Dim, class B, class W, class Real>
inline void sum_moments(const Target<T, Dim>& target, const mlsrk::Candidates<Real>& near,
                        T (&M)[B::kCount][B::kCount], T& crowding) {
  constexpr int N = B::kCount;
  for (auto& row : M)
    for (T& m : row) m = T(Real(0));
  crowding = T(Real(0));
  for (std::int32_t j = 0; j < near.count; ++j) {
    const Real* p = near.place + 4 * j;
    const auto e = Encounter<T, Dim, B, W>::template at<1>(target, p);
    crowding = crowding + e.phi.value;
    const T weight = e.phi.value * p[3];
    for (int k = 0; k < N; ++k) {
      const T hw = e.h[k] * weight;
      for (int l = 0; l <= k; ++l) M[k][l] = M[k][l] + hw * e.h[l];
    }
  }
}

/// P_B.
template <class T, int Dim, class B, class W, class Real>
inline void sum_slopes(const Target<T, Dim>& target, const mlsrk::Candidates<Real>& near,
                       const T (&b)[B::kCount], T (&P)[Dim][B::kCount]) {
  for (auto& row : P)
    for (T& p : row) p = T(Real(0));
  for (std::int32_t j = 0; j < near.count; ++j) {
    const Real* p = near.place + 4 * j;
    const auto e = Encounter<T, Dim, B, W>::template at<1>(target, p);
    const T corrected = dot(b, e.h) * p[3];
    for (int a = 0; a < Dim; ++a) {
      const T slope = corrected * e.phi.gradient[a];
      for (int k = 0; k < B::kCount; ++k) P[a][k] = P[a][k] + e.h[k] * slope;
    }
  }
}

/// Where M with its regularisation is singular, or so near to it that its inverse has no digits, it takes
/// r = smallest_pivot, which brings every pivot there.
template <class T, int Dim, class B, class W, class Real>
inline Shape<T, Dim, B> shape_of(const mlsrk::ShapeConstants<Real>& constants, const Target<T, Dim>& target,
                                 const mlsrk::Candidates<Real>& near) {
  constexpr int N = B::kCount;
  Shape<T, Dim, B> s;
  T M[N][N];
  sum_moments<T, Dim, B, W>(target, near, M, s.crowding);
  T r(constants.regularization);
  M[0][0] = M[0][0] + constants.constant_regularization;
  for (int k = 1; k < N; ++k) M[k][k] = M[k][k] + r;
  Ldlt<T, N> inverse = factorize(M);
  s.fallen = T(Real(0));
  if constexpr (N > 1) {
    s.fallen = select(inverse.smallest_pivot >= T(constants.smallest_pivot), s.fallen, T(Real(1)));
    const T more = s.fallen * constants.smallest_pivot;
    for (int k = 1; k < N; ++k) M[k][k] = M[k][k] + more;
    r = r + more;
    inverse = factorize(M);
  }
  for (T& b : s.b) b = T(Real(0));
  s.b[0] = T(Real(1));
  inverse.solve(s.b);
  T w[N];  // h(0) - R b
  w[0] = T(Real(1)) - s.b[0] * constants.constant_regularization;
  for (int k = 1; k < N; ++k) w[k] = -r * s.b[k];
  sum_slopes<T, Dim, B, W>(target, near, s.b, s.c);
  for (int a = 0; a < Dim; ++a) {
    T Dw[N];
    T Db[N];
    B::differentiate(a, w, Dw);
    B::derivative(a, s.b, Db);
    s.c[a][0] = s.c[a][0] + Dw[0] - Db[0] * constants.constant_regularization;
    for (int k = 1; k < N; ++k) s.c[a][k] = s.c[a][k] + Dw[k] - Db[k] * r;
    inverse.solve(s.c[a]);
  }
  return s;
}

/// [shape functions]
template <class T, class Real, int Dim, class B, class W>
void shape_functions(const mlsrk::ShapeConstants<Real>& constants, const mlsrk::Targets<Real>& targets,
                     const mlsrk::Candidates<Real>& near, Real* shape, Real* crowding, Real* fallen) {
  constexpr int N = B::kCount;
  constexpr int reals = N * (1 + Dim);
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto s = shape_of<T, Dim, B, W>(constants, Target<T, Dim>::load(targets, lane), near);
    for (int k = 0; k < N; ++k) Points<T>::store_row(s.b[k], shape, reals, k, lane);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < N; ++k) Points<T>::store_row(s.c[a][k], shape, reals, N + a * N + k, lane);
    Points<T>::store(s.crowding, crowding, lane);
    Points<T>::store(s.fallen, fallen, lane);
  }
}

}  // namespace lather::LATHER_LEVEL
