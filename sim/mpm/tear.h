#pragma once

// The deformation gradient of a tile, and the stages of tearing that work on tiles of a material that tears.
// Compiled per kernel level.

#include "sim/material/tearing.h"
#include "sim/mpm/tile.h"

namespace lather::LATHER_LEVEL {

template <class Real, int Dim>
inline HerschelBulkleyState<Lane<Real>> load_state(const Tile<Real, Dim>& tile) {
  const Lane<Real> zero(Real(0));
  HerschelBulkleyState<Lane<Real>> s;
  s.volume_change = tile.lane(Field::kVolumeChange);
  s.strain = {tile.lane(Field::kElasticStrain, 0),
              tile.lane(Field::kElasticStrain, 1),
              tile.lane(Field::kElasticStrain, 2),
              tile.lane(Field::kElasticStrain, 3),
              Dim == 3 ? tile.lane(Field::kElasticStrain, Dim == 3 ? 4 : 0) : zero,
              Dim == 3 ? tile.lane(Field::kElasticStrain, Dim == 3 ? 5 : 0) : zero};
  return s;
}

/// Calls visit(component, row, column) for the entries of F - I that a tile holds.
template <int Dim, class Visit>
inline void for_deformation(const Visit& visit) {
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) visit(a * Dim + b, a, b);
  if constexpr (Dim == 2) visit(4, 2, 2);
}

/// G = F - I.
template <class Real, int Dim>
inline Mat3<Lane<Real>> load_deformation(const Tile<Real, Dim>& tile) {
  Mat3<Lane<Real>> G;
  for (auto& row : G.m)
    for (Lane<Real>& entry : row) entry = Lane<Real>(Real(0));
  for_deformation<Dim>([&](int c, int a, int b) { G.m[a][b] = tile.lane(Field::kDeformation, c); });
  return G;
}
template <class Real, int Dim>
inline void store_deformation(const Tile<Real, Dim>& tile, const Mat3<Lane<Real>>& G) {
  for_deformation<Dim>([&](int c, int a, int b) { tile.put(Field::kDeformation, c, G.m[a][b]); });
}

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
