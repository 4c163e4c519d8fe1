#pragma once

// Positions after a step, and a check of the state. Compiled per kernel level.

#include "sim/mpm/tile.h"
#include "sim/particles/tile_check.h"

namespace lather::LATHER_LEVEL {

template <class Real, int Dim>
mpm::BlockExtremes advance(const mpm::BlockPoints<Real>& points, const mpm::StepConstants<Real>& step) {
  const Real to_cells = step.dt / step.cell;
  Lane<Real> largest(Real(0));
  Lane<Real> fastest(Real(0));
  Lane<Real> suspect(Real(0));  // see checked_volume_change()
  Lane<Real> smallest(Real(1));
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    Lane<Real> speed_squared(Real(0));
    for (int a = 0; a < Dim; ++a) {
      const Lane<Real> v = tile.lane(Field::kVelocity, a);
      const Lane<Real> d = v * to_cells;
      suspect += v - v;
      speed_squared += v * v;
      largest = max(abs(d), largest);
      // A runaway point is reported by the caller; until then it must not leave the buffer, so its move is
      // capped.
      const Lane<Real> one(Real(1));
      const Lane<Real> capped = select(abs(d) <= one, d, Lane<Real>(Real(0)));
      Real cells[kLanes];
      capped.store(cells);
      move(tile, a, cells, step.phase);
    }
    const Lane<Real> j = checked_volume_change(tile, suspect);
    smallest = min(j + Real(1), smallest);
    fastest = max(speed_squared, fastest);
  }
  mpm::BlockExtremes out;
  Real l[kLanes];
  Real f[kLanes];
  Real s[kLanes];
  Real j[kLanes];
  largest.store(l);
  fastest.store(f);
  suspect.store(s);
  smallest.store(j);
  for (int k = 0; k < kLanes; ++k) {
    if (l[k] > out.largest_cells) out.largest_cells = l[k];
    if (f[k] > out.speed_squared) out.speed_squared = f[k];
    out.finite = out.finite && s[k] == Real(0);
    out.collapsed = out.collapsed || j[k] <= Real(0);
  }
  return out;
}

}  // namespace lather::LATHER_LEVEL
