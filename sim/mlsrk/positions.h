#pragma once

// Positions and blended velocities after a step, and a check of the state. Compiled per kernel level.

#include "sim/mlsrk/kernels.h"
#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// J - 1 of F_e, or of J where no F is kept; adds x - x of every entry to `suspect`.
template <class Real, int Dim>
inline Lane<Real> checked_volume_change(const Tile<Real, Dim>& tile, Lane<Real>& suspect) {
  if (tile.has(Field::kElasticStrain))
    for (int c = 0; c < Tile<Real, Dim>::kStrainComponents; ++c) {
      const Lane<Real> b = tile.lane(Field::kElasticStrain, c);
      suspect += b - b;
    }
  if (tile.has(Field::kPlasticVolume)) {
    const Lane<Real> p = tile.lane(Field::kPlasticVolume);
    suspect += p - p;
  }
  const Lane<Real> j =
      tile.has(Field::kDeformation) ? det_minus_one(load_deformation(tile)) : tile.lane(Field::kVolumeChange);
  suspect += j - j;
  return j;
}

/// [positions]
template <class Real, int Dim>
mlsrk::TileExtremes positions(const mlsrk::SetTile<Real>& at, const mlsrk::MoveStep<Real>& step,
                              const Real* velocity, const Real* smooth) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const T zero(Real(0));
  T suspect = zero;  // x - x is 0 for finite x only; no maximum can hide a NaN here
  T largest = zero;
  T speed_squared = zero;
  for (int a = 0; a < Dim; ++a) {
    const T u = T::load(velocity + a * kLanes);
    const T d = u * Real(step.dt / step.cell);
    suspect += u - u;
    largest = max(abs(d), largest);
    // A runaway point is reported by the caller; until then its move is capped.
    Real cells[kLanes];
    select(abs(d) <= T(Real(1)), d, zero).store(cells);
    move(tile, a, cells, step.phase);
    const T blended = u + T::load(smooth + a * kLanes) * step.blend;
    suspect += blended - blended;
    speed_squared += blended * blended;
    tile.put(Field::kVelocity, a, blended);
  }
  const T j = checked_volume_change(tile, suspect);
  Real l[kLanes];
  Real f[kLanes];
  Real s[kLanes];
  Real J[kLanes];
  largest.store(l);
  speed_squared.store(f);
  suspect.store(s);
  (j + Real(1)).store(J);
  mlsrk::TileExtremes out;
  for (int k = 0; k < kLanes; ++k) {
    if (l[k] > out.largest_cells) out.largest_cells = l[k];
    if (f[k] > out.speed_squared) out.speed_squared = f[k];
    out.finite = out.finite && s[k] == Real(0);
    out.collapsed = out.collapsed || J[k] <= Real(0);
  }
  return out;
}

}  // namespace lather::LATHER_LEVEL
