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

template <class MaskType, class T>
inline Mat3<T> select(const MaskType& mask, const Mat3<T>& yes, const Mat3<T>& no) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r.m[i][j] = select(mask, yes.m[i][j], no.m[i][j]);
  return r;
}
template <class MaskType, class T>
inline Sym3<T> select(const MaskType& mask, const Sym3<T>& yes, const Sym3<T>& no) {
  return {select(mask, yes.xx, no.xx), select(mask, yes.yy, no.yy), select(mask, yes.zz, no.zz),
          select(mask, yes.xy, no.xy), select(mask, yes.xz, no.xz), select(mask, yes.yz, no.yz)};
}

template <class T>
inline Mat3<T> transpose(const Mat3<T>& a) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r.m[i][j] = a.m[j][i];
  return r;
}

/// a + c I
template <class T>
inline Mat3<T> add_isotropic(const Mat3<T>& a, const T& c) {
  Mat3<T> r = a;
  for (int i = 0; i < 3; ++i) r.m[i][i] = r.m[i][i] + c;
  return r;
}

template <class T>
inline Mat3<T> scale(const Mat3<T>& a, const T& c) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r.m[i][j] = a.m[i][j] * c;
  return r;
}

template <class T>
inline Mat3<T> full(const Sym3<T>& a) {
  return {{{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}}};
}

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

template <class T>
inline Mat3<T> sum(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r.m[i][j] = a.m[i][j] + b.m[i][j];
  return r;
}

template <class T>
inline Mat3<T> product(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  return r;
}

/// The cofactors of I + A, det(I + A) (I + A)^-T, minus I.
template <class T>
inline Mat3<T> cofactors_minus_identity(const Mat3<T>& A) {
  const auto& a = A.m;
  const T t = a[0][0] + a[1][1] + a[2][2];
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {  // tr(A) I - A^T + cof(A)
      const int i1 = (i + 1) % 3;
      const int i2 = (i + 2) % 3;
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      const T c = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1] - a[j][i];
      r.m[i][j] = i == j ? t + c : c;
    }
  return r;
}

/// (I + B)^-1 - I for symmetric B with det(I + B) = 1.
template <class T>
inline Sym3<T> unimodular_inverse_minus_identity(const Sym3<T>& B) {
  const Mat3<T> c = cofactors_minus_identity(full(B));
  return {c.m[0][0], c.m[1][1], c.m[2][2], c.m[0][1], c.m[0][2], c.m[1][2]};
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
