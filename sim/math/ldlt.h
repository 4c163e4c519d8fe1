#pragma once

// Small symmetric positive definite systems over a value type T (lanes or a plain real). Compiled per kernel
// level, like lane.h.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// A = L D L^T of size N; L has a unit diagonal.
template <class T, int N>
struct Ldlt {
  T lower[N][N];     ///< below the diagonal
  T inverse_d[N];    ///< 1/D
  T smallest_pivot;  ///< least of D[1 … N-1] (of D[0] where N = 1): how far from singular

  /// x with A x = b, in place.
  void solve(T (&x)[N]) const {
    for (int i = 1; i < N; ++i)
      for (int k = 0; k < i; ++k) x[i] = x[i] - lower[i][k] * x[k];
    for (int i = 0; i < N; ++i) x[i] = x[i] * inverse_d[i];
    for (int i = N - 2; i >= 0; --i)
      for (int k = i + 1; k < N; ++k) x[i] = x[i] - lower[k][i] * x[k];
  }
};

/// Factorises the symmetric `a`, whose lower triangle is read.
template <class T, int N>
inline Ldlt<T, N> factorize(const T (&a)[N][N]) {
  using Real = typename ScalarOf<T>::type;
  Ldlt<T, N> f;
  T ld[N][N];  // L D
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < i; ++j) {
      T sum = a[i][j];
      for (int k = 0; k < j; ++k) sum = sum - ld[i][k] * f.lower[j][k];
      ld[i][j] = sum;
      f.lower[i][j] = sum * f.inverse_d[j];
    }
    T d = a[i][i];
    for (int k = 0; k < i; ++k) d = d - ld[i][k] * f.lower[i][k];
    f.smallest_pivot = i < 2 ? d : min(d, f.smallest_pivot);
    f.inverse_d[i] = T(Real(1)) / d;
  }
  return f;
}

}  // namespace lather::LATHER_LEVEL
