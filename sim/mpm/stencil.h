#pragma once

// Where a tile's points stand in their block's buffer, and their kernel weights. Compiled per kernel level.

#include "sim/math/quad.h"
#include "sim/mpm/bspline.h"
#include "sim/mpm/tile.h"

namespace lather::LATHER_LEVEL {

/// Nodes that a point reaches along an axis; rows of the last axis are always read four wide.
constexpr int nodes_per_axis(bool cubic) {
  return cubic ? 4 : 3;
}

/// Weights of the 16 points of a tile: lane k of w[axis][node] is point k's. The last axis' weights are
/// quads, one a point: those of a row of four nodes.
template <class Real, int Dim, bool Cubic, bool Apic>
struct Stencil {
  static constexpr int kNodes = nodes_per_axis(Cubic);

  alignas(64) Real w[Dim - 1][4][kLanes];
  alignas(64) Real d[Dim - 1][4][kLanes];               ///< derivative, per cell width
  alignas(64) Real arm[Apic ? Dim - 1 : 1][4][kLanes];  ///< APIC: weight times node minus point, cell widths
  Quads<Real> row_w;
  Quads<Real> row_d;
  Quads<Real> row_arm;
  std::int32_t base[kLanes];  ///< reals from the buffer's start to the first node

  Stencil(const Tile<Real, Dim>& tile, const mpm::BlockPlace& place) {
    for (int k = 0; k < kLanes; ++k) base[k] = 0;
    for (int axis = 0; axis < Dim - 1; ++axis) {
      const Along at(tile, place, axis, base);
      for (int n = 0; n < 4; ++n) {
        at.weights.w[n].store(w[axis][n]);
        at.weights.d[n].store(d[axis][n]);
        if constexpr (Apic) at.arm(n).store(arm[axis][n]);
      }
    }
    const Along at(tile, place, Dim - 1, base);
    const auto& weights = at.weights;
    row_w.put(weights.w[0], weights.w[1], weights.w[2], weights.w[3]);
    row_d.put(weights.d[0], weights.d[1], weights.d[2], weights.d[3]);
    if constexpr (Apic) row_arm.put(at.arm(0), at.arm(1), at.arm(2), at.arm(3));
    for (int k = 0; k < kLanes; ++k) base[k] *= mpm::kQuad;
  }

 private:
  /// The points along one axis; `base`, the index of their first nodes, gets one axis longer.
  struct Along {
    Weights1<Lane<Real>> weights;
    Lane<Real> from_first;  ///< point minus first node, cell widths

    Along(const Tile<Real, Dim>& tile, const mpm::BlockPlace& place, int axis, std::int32_t (&base)[kLanes]) {
      const Lane<Real> f = tile.fraction(axis);
      const std::int16_t* cell = tile.cell(axis);
      const int origin = place.first_node[axis] - mpm::kBufferBelow;
      if constexpr (Cubic) {
        weights = cubic_weights(f);
        from_first = f + Real(1);
        for (int k = 0; k < kLanes; ++k) base[k] = base[k] * mpm::kBufferWidth + (cell[k] - 1 - origin);
      } else {
        const auto upper = f >= Lane<Real>(Real(0.5));
        const Lane<Real> u = select(upper, f - Real(1), f);
        weights = quadratic_weights(u);
        from_first = u + Real(1);
        Real shift[kLanes];
        select(upper, Lane<Real>(Real(0)), Lane<Real>(Real(-1))).store(shift);
        for (int k = 0; k < kLanes; ++k)
          base[k] = base[k] * mpm::kBufferWidth + (cell[k] + static_cast<int>(shift[k]) - origin);
      }
    }
    Lane<Real> arm(int n) const { return weights.w[n] * (Lane<Real>(Real(n)) - from_first); }
  };
};

/// Reals from one row of the buffer to the next along the last axis but one, and the one before it.
inline constexpr int kRowStride = mpm::kQuad * mpm::kBufferWidth;
inline constexpr int kPlaneStride = kRowStride * mpm::kBufferWidth;

}  // namespace lather::LATHER_LEVEL
