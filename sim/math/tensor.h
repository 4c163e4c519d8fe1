#pragma once

// Small tensors over a value type T: Lane<Real> for 16 points at once, or a plain real.
// Compiled per kernel level, like lane.h.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

template <class T>
struct Mat3 {
  T m[3][3];
};

/// A symmetric tensor: xx yy zz xy xz yz.
template <class T>
struct Sym3 {
  T xx, yy, zz, xy, xz, yz;
};

template <class T>
inline T trace(const Sym3<T>& a) {
  return a.xx + a.yy + a.zz;
}

/// a + c I
template <class T>
inline Sym3<T> add_isotropic(const Sym3<T>& a, const T& c) {
  return {a.xx + c, a.yy + c, a.zz + c, a.xy, a.xz, a.yz};
}

template <class T>
inline Sym3<T> scale(const Sym3<T>& a, const T& c) {
  return {a.xx * c, a.yy * c, a.zz * c, a.xy * c, a.xz * c, a.yz * c};
}

template <class T>
inline Sym3<T> deviator(const Sym3<T>& a) {
  using Real = typename ScalarOf<T>::type;
  return add_isotropic(a, trace(a) * Real(-1.0 / 3.0));
}

/// Frobenius norm squared.
template <class T>
inline T norm_squared(const Sym3<T>& a) {
  using Real = typename ScalarOf<T>::type;
  return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz) * Real(2);
}

/// det(I + a) - 1 without forming I + a, so that small strains keep their digits.
template <class T>
inline T det_minus_one(const Sym3<T>& a) {
  const T minors = a.xx * a.yy - a.xy * a.xy + a.xx * a.zz - a.xz * a.xz + a.yy * a.zz - a.yz * a.yz;
  const T det = a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
                a.xz * (a.xy * a.yz - a.yy * a.xz);
  return trace(a) + minors + det;
}

template <class T>
inline T det_minus_one(const Mat3<T>& a) {
  const auto& m = a.m;
  const T minors = m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] - m[0][2] * m[2][0] +
                   m[1][1] * m[2][2] - m[1][2] * m[2][1];
  const T det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return m[0][0] + m[1][1] + m[2][2] + minors + det;
}

/// (I + A)(I + B)(I + A)^T - I for symmetric B, again without forming the sums with I.
template <class T>
inline Sym3<T> push_forward_minus_identity(const Mat3<T>& A, const Sym3<T>& B) {
  const T b[3][3] = {{B.xx, B.xy, B.xz}, {B.xy, B.yy, B.yz}, {B.xz, B.yz, B.zz}};
  T ab[3][3];  // A B + B + A: (I + A)(I + B) - I
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      ab[i][j] = A.m[i][j] + b[i][j] + (A.m[i][0] * b[0][j] + A.m[i][1] * b[1][j] + A.m[i][2] * b[2][j]);
  const auto entry = [&](int i, int j) {  // (I + ab)(I + A)^T - I
    return ab[i][j] + A.m[j][i] + (ab[i][0] * A.m[j][0] + ab[i][1] * A.m[j][1] + ab[i][2] * A.m[j][2]);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

}  // namespace lather::LATHER_LEVEL
