#pragma once

// What a point reads from the rows of four nodes around it: a row's nodes times (any, x, y, z) are one lane
// of 16, and sums over all nodes are sums over rows, weighted along the last axis and folded. Compiled per
// kernel level.

#include "sim/math/tensor.h"
#include "sim/mpm/stencil.h"

namespace lather::LATHER_LEVEL {

/// sum_n lanes[n] weights[n] of point k
template <class Real, int kNodes>
inline Lane<Real> weighted(const Lane<Real> (&lanes)[kNodes], const Real (&weights)[4][kLanes], int k) {
  Lane<Real> sum = lanes[0] * weights[0][k];
  for (int n = 1; n < kNodes; ++n) sum += lanes[n] * weights[n][k];
  return sum;
}

/// Point k's rows (i, j), summed along one axis: x[i] = sum_j w_j row, y[j] = sum_i w_i row. In 2D x[i] is
/// row i, and y is not there.
template <class Real, int Dim, bool Cubic>
struct RowSums {
  static constexpr int kNodes = nodes_per_axis(Cubic);
  Lane<Real> x[kNodes];
  Lane<Real> y[kNodes];

  template <bool Apic>
  RowSums(const Stencil<Real, Dim, Cubic, Apic>& s, int k, const Real* buffer) {
    const Real* rows = buffer + s.base[k];
    for (int i = 0; i < kNodes; ++i) {
      if constexpr (Dim == 2) {
        x[i] = Lane<Real>::load(rows + i * kRowStride);
      } else {
        for (int j = 0; j < kNodes; ++j) {
          const Lane<Real> row = Lane<Real>::load(rows + i * kPlaneStride + j * kRowStride);
          x[i] = j == 0 ? row * s.w[1][j][k] : x[i] + row * s.w[1][j][k];
          y[j] = i == 0 ? row * s.w[0][i][k] : y[j] + row * s.w[0][i][k];
        }
      }
    }
  }
};

/// Point k's sum over rows of w_i w_j times the row.
template <class Real, int Dim, bool Cubic, bool Apic>
inline Lane<Real> row_sum(const Stencil<Real, Dim, Cubic, Apic>& s, int k, const Real* buffer) {
  const Real* rows = buffer + s.base[k];
  Lane<Real> sum(Real(0));
  for (int i = 0; i < s.kNodes; ++i) {
    if constexpr (Dim == 2) {
      sum += Lane<Real>::load(rows + i * kRowStride) * s.w[0][i][k];
    } else {
      Lane<Real> x = Lane<Real>::load(rows + i * kPlaneStride) * s.w[1][0][k];
      for (int j = 1; j < s.kNodes; ++j)
        x += Lane<Real>::load(rows + i * kPlaneStride + j * kRowStride) * s.w[1][j][k];
      sum += x * s.w[0][i][k];
    }
  }
  return sum;
}

/// gradient[b] = sum u d_b w of point k, times the cell width, as quads (any, x, y, z); `value` is the sum
/// over rows of w_i w_j times the row.
template <class Real, int Dim, bool Cubic, bool Apic>
inline void fold_gradient(const Stencil<Real, Dim, Cubic, Apic>& s, int k,
                          const RowSums<Real, Dim, Cubic>& rows, const Lane<Real>& value,
                          Quads<Real> (&gradient)[Dim]) {
  const Lane<Real> w_row = spread(s.row_w[k]);
  fold(weighted(rows.x, s.d[0], k) * w_row, gradient[0][k]);
  if constexpr (Dim == 3) fold(weighted(rows.y, s.d[1], k) * w_row, gradient[1][k]);
  fold(value * spread(s.row_d[k]), gradient[Dim - 1][k]);
}

/// The vectors (x, y, z) of a tile's points, from quads (any, x, y, z).
template <class Real>
struct Vectors {
  explicit Vectors(const Quads<Real>& quads) { quads.get(part); }
  const Lane<Real>& operator[](int a) const { return part[1 + a]; }
  Lane<Real> part[4];
};

/// The matrices whose columns are given, times `factor`; zero across the plane in 2D.
template <class Real, int Dim>
inline Mat3<Lane<Real>> scaled_columns(const Quads<Real> (&columns)[Dim], Real factor) {
  Mat3<Lane<Real>> A;
  for (auto& row : A.m)
    for (Lane<Real>& entry : row) entry = Lane<Real>(Real(0));
  for (int b = 0; b < Dim; ++b) {
    const Vectors<Real> column(columns[b]);
    for (int a = 0; a < Dim; ++a) A.m[a][b] = column[a] * factor;
  }
  return A;
}

}  // namespace lather::LATHER_LEVEL
