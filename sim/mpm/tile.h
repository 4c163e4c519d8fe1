#pragma once

// The tiles of a block's points. Compiled per kernel level.

#include "sim/mpm/kernels.h"
#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// The tile of a block's point `first`, a multiple of 16.
template <class Real, int Dim>
inline Tile<Real, Dim> tile_at(const mpm::BlockPoints<Real>& points, int first) {
  return {points.tiles + static_cast<std::ptrdiff_t>(first / kLanes) * points.layout->stride, points.layout};
}

/// A tile as its law's kernels take it.
template <class Real, int Dim>
inline mpm::PointTile<Real> point_tile(const Tile<Real, Dim>& tile,
                                       const mpm::MaterialConstants<Real>& material) {
  return {tile.at, tile.layout, &material};
}

}  // namespace lather::LATHER_LEVEL
