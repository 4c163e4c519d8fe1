#pragma once

// Eigenvalues and eigenvectors of symmetric tensors, and the rotation in a deformation. Compiled per kernel
// level, like lane.h; T is a lane of tensors or one plain real.
//
// Cyclic Jacobi: each rotation makes one off-diagonal entry 0, the squares of the others shrink, and the last
// sweeps converge quadratically. It needs no case for repeated eigenvalues, and it is exact to a few units of
// rounding of the largest entry.

#include <limits>

#include "sim/math/tensor.h"

namespace lather::LATHER_LEVEL {

template <class T>
struct Eigenpairs {
  T value[3];      ///< in no order
  T vector[3][3];  ///< [k]: of value[k], unit length, orthogonal to the others
};

/// sum_k value[k] vector[k] vector[k]^T
template <class T>
inline Sym3<T> assemble(const T (&value)[3], const T (&vector)[3][3]) {
  const auto entry = [&](int i, int j) {
    return value[0] * vector[0][i] * vector[0][j] + value[1] * vector[1][i] * vector[1][j] +
           value[2] * vector[2][i] * vector[2][j];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

/// Tangent of the rotation, at most 45 degrees, that makes the entry pq of ((pp, pq), (pq, qq)) 0. Entries
/// are at most about 1.
template <class T>
inline T jacobi_tangent(const T& pp, const T& qq, const T& pq) {
  using Real = typename ScalarOf<T>::type;
  const T zero(Real(0));
  const T difference = qq - pp;
  const T twice = pq * Real(2);
  const T length = sqrt(difference * difference + twice * twice);
  // 2 pq / (d + sign(d) sqrt(d^2 + 4 pq^2)); where squares of entries vanish, so does the rotation.
  const T divisor = select(difference < zero, difference - length, difference + length);
  const auto turns = length > T(Real(8) * std::numeric_limits<Real>::min());
  return select(turns, twice / select(turns, divisor, T(Real(1))), zero);
}

/// Diagonalises `a` by rotations, which are applied to the vectors v[0 … 2] if there are any.
template <bool Vectors, class T>
[[gnu::noinline]] void jacobi(Mat3<T>& a, T (*v)[3]) {
  using Real = typename ScalarOf<T>::type;
  constexpr Real kSmall = Real(0.25) * std::numeric_limits<Real>::epsilon();
  constexpr int kMostSweeps = sizeof(Real) == 4 ? 6 : 8;  // the last ones only for the hardest of 16 tensors
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const int r = 3 - p - q;
        const T t = jacobi_tangent(a.m[p][p], a.m[q][q], a.m[p][q]);
        const T c = T(Real(1)) / sqrt(t * t + Real(1));
        const T s = t * c;
        a.m[p][p] = a.m[p][p] - t * a.m[p][q];
        a.m[q][q] = a.m[q][q] + t * a.m[p][q];
        a.m[p][q] = a.m[q][p] = T(Real(0));
        const T rp = a.m[r][p];
        const T rq = a.m[r][q];
        a.m[r][p] = a.m[p][r] = c * rp - s * rq;
        a.m[r][q] = a.m[q][r] = s * rp + c * rq;
        if constexpr (Vectors)
          for (int i = 0; i < 3; ++i) {
            const T vp = v[p][i];
            const T vq = v[q][i];
            v[p][i] = c * vp - s * vq;
            v[q][i] = s * vp + c * vq;
          }
      }
    // What is left couples eigenvalues by its square over their difference, and turns vectors by itself over
    // it.
    if (!any(max(abs(a.m[0][1]), max(abs(a.m[0][2]), abs(a.m[1][2]))) > T(kSmall))) break;
  }
}

/// Largest magnitude of an entry; 1 where all are 0, so that one may divide by it.
template <class T>
inline T largest_entry(const Sym3<T>& a) {
  using Real = typename ScalarOf<T>::type;
  const T largest = max(max(max(abs(a.xx), abs(a.yy)), max(abs(a.zz), abs(a.xy))), max(abs(a.xz), abs(a.yz)));
  return select(largest > T(Real(0)), largest, T(Real(1)));
}

template <class T>
inline Mat3<T> divide(const Sym3<T>& a, const T& by) {
  return full(Sym3<T>{a.xx / by, a.yy / by, a.zz / by, a.xy / by, a.xz / by, a.yz / by});
}

/// Eigenvalues and eigenvectors, to a few epsilon of the largest entry, at any scale.
template <class T>
inline Eigenpairs<T> eigenpairs(const Sym3<T>& a) {
  using Real = typename ScalarOf<T>::type;
  const T size = largest_entry(a);
  Mat3<T> diagonal = divide(a, size);
  Eigenpairs<T> e;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e.vector[k][i] = T(Real(i == k ? 1 : 0));
  jacobi<true>(diagonal, e.vector);
  for (int k = 0; k < 3; ++k) e.value[k] = diagonal.m[k][k] * size;
  return e;
}

template <class T>
inline T largest_eigenvalue(const Sym3<T>& a) {
  const T size = largest_entry(a);
  Mat3<T> diagonal = divide(a, size);
  jacobi<false, T>(diagonal, nullptr);
  return max(diagonal.m[0][0], max(diagonal.m[1][1], diagonal.m[2][2])) * size;
}

template <class T>
inline T norm_squared(const Mat3<T>& a) {
  T sum = a.m[0][0] * a.m[0][0];
  for (int i = 1; i < 9; ++i) sum = sum + a.m[i / 3][i % 3] * a.m[i / 3][i % 3];
  return sum;
}

/// R - I, with R the rotation U V^T of f = I + A = U S V^T; for det(f) > 0, of about 1.
///
/// Newton's iteration X <- (X + X^-T)/2, which squares the error (Higham 1986), on Y = X - I, so that a small
/// increment keeps its digits. Far from a rotation X is scaled by the root of |X^-T|/|X|, which balances
/// large and small stretches; a stretch of 1e6 then takes 6 iterations, an increment of a step one or two.
template <class T>
[[gnu::noinline]] Mat3<T> polar_rotation_minus_identity(const Mat3<T>& A) {
  using Real = typename ScalarOf<T>::type;
  constexpr int kMostIterations = 20;
  constexpr Real kEnough = sizeof(Real) == 4 ? Real(3e-6) : Real(1e-10);  // half its square is what is left
  const T one(Real(1));
  Mat3<T> Y = A;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const T d = det_minus_one(Y);
    const T per_det = one / (d + Real(1));
    const Mat3<T> W = scale(add_isotropic(cofactors_minus_identity(Y), -d), per_det);  // X^-T - I
    const T size = norm_squared(add_isotropic(Y, one));
    const T inverse_size = norm_squared(add_isotropic(W, one));
    const auto far = max(size, inverse_size) > T(Real(4));  // 3 for a rotation
    const T g = select(far, sqrt(sqrt(inverse_size / size)), one);
    const Mat3<T> y = scale(Y, Real(0.5) * g);
    const Mat3<T> w = scale(W, Real(0.5) / g);
    const T shift = select(far, (g + one / g) * Real(0.5) - Real(1), T(Real(0)));
    T change(Real(0));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        T next = y.m[i][j] + w.m[i][j];
        if (i == j) next = next + shift;
        change = max(abs(next - Y.m[i][j]), change);
        Y.m[i][j] = next;
      }
    if (!any(change > T(kEnough))) break;
  }
  return Y;
}

}  // namespace lather::LATHER_LEVEL
