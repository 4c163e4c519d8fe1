#pragma once

// Positions and blended velocities after a step, and a check of the state. Compiled per kernel level.

#include "sim/mlsrk/kernels.h"
#include "sim/particles/tile_check.h"

namespace lather::LATHER_LEVEL {

/// [positions]
template <class Real, int Dim>
mlsrk::TileExtremes positions(const mlsrk::SetTile<Real>& at, const mlsrk::MoveStep<Real>& step,
                              const Real* velocity, const Real* smooth) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const T zero(Real(0));
  T suspect = zero;  // see checked_volume_change()
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
  if (tile.has(Field::kConcentration)) {
    const double* c = tile.template field<double>(Field::kConcentration);
    for (int k = 0; k < kLanes; ++k) out.finite = out.finite && c[k] - c[k] == 0;
  }
  return out;
}

}  // namespace lather::LATHER_LEVEL
