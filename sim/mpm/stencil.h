#pragma once

// Where a tile's points stand in their block's buffer, and their kernel weights. Compiled per kernel level.

#include "sim/mpm/bspline.h"
#include "sim/mpm/tile.h"

namespace lather::LATHER_LEVEL {

/// Weights of the 16 points of a tile: lane k of w[axis][node] is point k's.
template <class Real, int Dim, bool Cubic>
struct Stencil {
  static constexpr int kNodes = Cubic ? 4 : 3;  ///< per axis; rows are always read four wide

  alignas(64) Real w[Dim][4][kLanes];
  alignas(64) Real d[Dim][4][kLanes];    ///< derivative, per cell width
  alignas(64) Real rel[Dim][4][kLanes];  ///< node minus point, cell widths
  std::int32_t base[kLanes];             ///< reals from the buffer's start to the first node

  Stencil(const Tile<Real, Dim>& tile, const mpm::BlockPlace& place) {
    using mpm::kBufferWidth;
    for (int k = 0; k < kLanes; ++k) base[k] = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const Lane<Real> f = tile.fraction(axis);
      const std::int16_t* cell = tile.cell(axis);
      const int origin = place.first_node[axis] - mpm::kBufferBelow;
      Weights1<Lane<Real>> weights;
      Lane<Real> from_first;  // point minus first node, cell widths
      if constexpr (Cubic) {
        weights = cubic_weights(f);
        from_first = f + Real(1);
        for (int k = 0; k < kLanes; ++k) base[k] = base[k] * kBufferWidth + (cell[k] - 1 - origin);
      } else {
        const auto upper = f >= Lane<Real>(Real(0.5));
        const Lane<Real> u = select(upper, f - Real(1), f);
        weights = quadratic_weights(u);
        from_first = u + Real(1);
        Real shift[kLanes];
        select(upper, Lane<Real>(Real(0)), Lane<Real>(Real(-1))).store(shift);
        for (int k = 0; k < kLanes; ++k)
          base[k] = base[k] * kBufferWidth + (cell[k] + static_cast<int>(shift[k]) - origin);
      }
      for (int n = 0; n < 4; ++n) {
        weights.w[n].store(w[axis][n]);
        weights.d[n].store(d[axis][n]);
        (Lane<Real>(Real(n)) - from_first).store(rel[axis][n]);
      }
    }
    for (int k = 0; k < kLanes; ++k) base[k] *= mpm::kQuad;
  }

  /// The last axis' weights, derivatives, or weighted distances of point k: a row of four nodes.
  Quad<Real> row_weights(int k) const {
    return {{w[Dim - 1][0][k], w[Dim - 1][1][k], w[Dim - 1][2][k], w[Dim - 1][3][k]}};
  }
  Quad<Real> row_derivatives(int k) const {
    return {{d[Dim - 1][0][k], d[Dim - 1][1][k], d[Dim - 1][2][k], d[Dim - 1][3][k]}};
  }
  Quad<Real> row_arms(int k) const {
    Quad<Real> q;
    for (int n = 0; n < 4; ++n) q.v[n] = w[Dim - 1][n][k] * rel[Dim - 1][n][k];
    return q;
  }
};

/// Reals from one row of the buffer to the next along the last axis but one, and the one before it.
inline constexpr int kRowStride = mpm::kQuad * mpm::kBufferWidth;
inline constexpr int kPlaneStride = kRowStride * mpm::kBufferWidth;

}  // namespace lather::LATHER_LEVEL
