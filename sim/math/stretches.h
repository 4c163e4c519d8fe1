#pragma once

// Principal stretches of a deformation F = I + G = sum_k w_k v_k^T, w_k = exp(eps_k) u_k (its singular value
// decomposition F = U S V^T with S = exp(eps)), and maps of them that need no left vectors. Compiled per
// kernel level; T is a lane of points or one plain real.
//
// Small strains keep their digits: v_k are the eigenvectors of C - I = G + G^T + G^T G, and
// eps_k = log1p(2 v.Gv + |Gv|^2)/2. Where stretches lie far from 1, C has squared their ratio and its
// eigenvectors mix the small ones; there rotations of the columns of F V (one-sided Jacobi) finish the work,
// so that the stretches are exact to a few epsilon of the largest one: what a rounding of F changes too.

#include <type_traits>
#include <utility>

#include "sim/math/eigen.h"

namespace lather::LATHER_LEVEL {

template <class T>
using MaskOf = std::remove_cv_t<decltype(std::declval<T>() > std::declval<T>())>;

template <class T>
struct Stretches {
  T log[3];         ///< eps_k, in no order; a G without z parts has eps_2 = 0 along z
  T right[3][3];    ///< [k]: v_k, orthonormal
  T image[3][3];    ///< [k]: w_k, orthogonal
  MaskOf<T> large;  ///< some stretch lies far from 1 (C - I has an eigenvalue beyond 3/4)
};

template <class T>
inline T inner_product(const T (&a)[3], const T (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// (I + G)(I + G)^T - I
template <class T>
inline Sym3<T> left_cauchy_green_minus_identity(const Mat3<T>& G) {
  const auto entry = [&](int i, int j) { return G.m[i][j] + G.m[j][i] + inner_product(G.m[i], G.m[j]); };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

template <class T>
inline void rotate_pair(T (&a)[3], T (&b)[3], const T& c, const T& s) {
  for (int i = 0; i < 3; ++i) {
    const T p = a[i];
    const T q = b[i];
    a[i] = c * p - s * q;
    b[i] = s * p + c * q;
  }
}

/// Makes the w_k = F v_k of some lanes orthogonal by rotations, which are applied to v_k as well.
template <class T>
[[gnu::noinline]] void orthogonalize(T (&w)[3][3], T (&v)[3][3], const MaskOf<T>& lanes) {
  using Real = typename ScalarOf<T>::type;
  constexpr Real kCosine = Real(4) * std::numeric_limits<Real>::epsilon();
  constexpr int kMostSweeps = 8;
  const T zero(Real(0));
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    T excess = zero;  // of a squared cosine, times the shares of the two squared lengths
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const T pp = inner_product(w[p], w[p]);
        const T qq = inner_product(w[q], w[q]);
        const T sum = pp + qq;
        const auto turns = (sum > zero) & lanes;
        const T share = T(Real(1)) / select(turns, sum, T(Real(1)));
        const T cross = select(turns, inner_product(w[p], w[q]) * share, zero);
        const T t = select(turns, jacobi_tangent(pp * share, qq * share, cross), zero);
        const T c = T(Real(1)) / sqrt(t * t + Real(1));
        rotate_pair(w[p], w[q], c, t * c);
        rotate_pair(v[p], v[q], c, t * c);
        excess = max(cross * cross - (pp * share) * (qq * share) * Real(kCosine * kCosine), excess);
      }
    if (!any(excess > zero)) break;
  }
}

/// For det(I + G) > 0. Stretches from 1e-9 to 1e9 do not overflow, whatever the precision.
template <class T>
inline Stretches<T> stretches(const Mat3<T>& G) {
  using Real = typename ScalarOf<T>::type;
  const Eigenpairs<T> e = eigenpairs(left_cauchy_green_minus_identity(transpose(G)));
  const T farthest = max(abs(e.value[0]), max(abs(e.value[1]), abs(e.value[2])));
  Stretches<T> s;
  s.large = farthest > T(Real(0.75));
  T squared_minus_one[3];
  for (int k = 0; k < 3; ++k) {
    const T(&v)[3] = e.vector[k];
    const T Gv[3] = {inner_product(G.m[0], v), inner_product(G.m[1], v), inner_product(G.m[2], v)};
    squared_minus_one[k] = inner_product(v, Gv) * Real(2) + inner_product(Gv, Gv);
    for (int i = 0; i < 3; ++i) {
      s.right[k][i] = v[i];
      s.image[k][i] = v[i] + Gv[i];
    }
  }
  const bool some_large = any(s.large);
  if (some_large) orthogonalize(s.image, s.right, s.large);
  for (int k = 0; k < 3; ++k) {
    s.log[k] = log1p(select(s.large, T(Real(0)), squared_minus_one[k])) * Real(0.5);
    if (some_large) {
      const T squared = max(inner_product(s.image[k], s.image[k]), T(std::numeric_limits<Real>::min()));
      s.log[k] = select(s.large, log(squared) * Real(0.5), s.log[k]);
    }
  }
  return s;
}

/// F~ - I with eps~_k = eps_k + change_k along the same directions. Where no stretch changes it is G itself.
template <class T>
inline Mat3<T> stretched(const Mat3<T>& G, const Stretches<T>& s, const T (&change)[3]) {
  using Real = typename ScalarOf<T>::type;
  const T zero(Real(0));
  // A small change is added to G. A large stretch's own rounding would stay in that sum: it is made anew.
  const auto anew = s.large & (max(abs(change[0]), max(abs(change[1]), abs(change[2]))) > zero);
  T scaled[3][3];  // [k]: what F gains along v_k
  for (int k = 0; k < 3; ++k) {
    const T factor = select(anew, exp(change[k]), expm1(change[k]));
    for (int i = 0; i < 3; ++i) scaled[k][i] = s.image[k][i] * factor;
  }
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      r.m[i][j] =
          select(anew, T(Real(i == j ? -1 : 0)), G.m[i][j]) +
          (scaled[0][i] * s.right[0][j] + scaled[1][i] * s.right[1][j] + scaled[2][i] * s.right[2][j]);
  return r;
}

}  // namespace lather::LATHER_LEVEL
