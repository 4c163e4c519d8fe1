#pragma once

// Polynomials of the moving least squares [MLSRK Table 1]. Compiled per kernel level.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// Monomials up to `Order` in Dim variables: 1; x y z; xx yy zz, then xy (2D) or xy yz zx (3D).
template <int Order, int Dim>
struct Basis {
  static constexpr int kMixed = Dim == 3 ? 3 : 1;
  static constexpr int kCount = Order == 0 ? 1 : Order == 1 ? 1 + Dim : 1 + 2 * Dim + kMixed;

  /// Index of the monomial x_a x_b.
  static constexpr int second(int a, int b) {
    if (a == b) return 1 + Dim + a;
    if (Dim == 2) return 1 + 2 * Dim;
    return 1 + 2 * Dim + (a + b == 1 ? 0 : a + b == 3 ? 1 : 2);
  }

  template <class T>
  static void evaluate(const T (&x)[Dim], T (&h)[kCount]) {
    using Real = typename ScalarOf<T>::type;
    h[0] = T(Real(1));
    if constexpr (Order >= 1)
      for (int a = 0; a < Dim; ++a) h[1 + a] = x[a];
    if constexpr (Order >= 2)
      for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) h[second(a, b)] = x[a] * x[b];
  }

  /// D w, where the derivatives of the monomials along `axis` are D h.
  template <class T>
  static void differentiate(int axis, const T (&w)[kCount], T (&out)[kCount]) {
    using Real = typename ScalarOf<T>::type;
    for (T& o : out) o = T(Real(0));
    if constexpr (Order >= 1) out[1 + axis] = w[0];
    if constexpr (Order >= 2)
      for (int a = 0; a < Dim; ++a) out[second(a, axis)] = a == axis ? w[1 + axis] * Real(2) : w[1 + a];
  }

  /// D^T b: the coefficients of the polynomial that is the derivative of b . h along `axis`.
  template <class T>
  static void derivative(int axis, const T (&b)[kCount], T (&out)[kCount]) {
    using Real = typename ScalarOf<T>::type;
    for (T& o : out) o = T(Real(0));
    if constexpr (Order >= 1) out[0] = b[1 + axis];
    if constexpr (Order >= 2)
      for (int a = 0; a < Dim; ++a) out[1 + a] = a == axis ? b[second(a, a)] * Real(2) : b[second(a, axis)];
  }
};

}  // namespace lather::LATHER_LEVEL
