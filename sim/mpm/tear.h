#pragma once

// The stages of tearing that work on tiles of a material that tears.
// Compiled per kernel level.

#include "sim/material/tearing.h"
#include "sim/mpm/tile.h"

namespace lather::LATHER_LEVEL {

/// Points labelled by detect_tearing(). Only tiles with the field kPlasticity may be asked.
template <class Real, int Dim>
inline Mask<Real> weak_points(const Tile<Real, Dim>& tile, const TearingConstants<Real>& c) {
  return tile.lane(Field::kPlasticity) > Lane<Real>(c.tear_threshold);
}

/// [2. detect tearing regions] [Foam E.3 step 2, Algorithm 7]
template <class Real, int Dim>
void detect_tearing(const mpm::BlockPoints<Real>& points) {
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    tile.put(Field::kPlasticity, 0, accumulated_plasticity(load_state(tile), load_deformation(tile)));
  }
}

/// [4. limit forces] of weak points. [Foam E.3 step 4, Algorithm 8]
template <class Real, int Dim>
inline void limit_stress(const Tile<Real, Dim>& tile, const TearingConstants<Real>& c,
                         Sym3<Lane<Real>>& tau) {
  const Mask<Real> weak = weak_points(tile, c);
  if (any(weak)) tau = select(weak, limited_stress(tau), tau);
}

/// [8. limit deformation] of weak points: A = f - I becomes f_corr - I. [Foam E.3 step 8, Algorithm 11]
template <class Real, int Dim>
inline void limit_increment(const Tile<Real, Dim>& tile, const TearingConstants<Real>& c,
                            Mat3<Lane<Real>>& A) {
  const Mask<Real> weak = weak_points(tile, c);
  if (any(weak)) A = select(weak, limited_increment(load_state(tile), A), A);
}

/// [11. plastic recovery] with exponent = (exp(-t/eta_p) - 1)/2. [Foam E.3 step 11, Algorithm 14]
template <class Real, int Dim>
void recover(const mpm::BlockPoints<Real>& points, Real exponent) {
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    store_deformation(tile, recovered(load_state(tile), load_deformation(tile), Lane<Real>(exponent)));
  }
}

}  // namespace lather::LATHER_LEVEL
