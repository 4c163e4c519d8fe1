#pragma once

// The laws as the stages of this solver use them, tile by tile. Compiled per kernel level.

#include "sim/mpm/kernels.h"
#include "sim/particles/laws_on_tiles.h"

namespace lather::LATHER_LEVEL {

/// See LawKernels::stress.
template <class Real, int Dim, template <class, int, class> class OnTile>
Real law_stress(const mpm::PointTile<Real>& at, Real* tau) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  Lane<Real> stiffest(Real(1));
  const Sym3<Lane<Real>> s = stress_of_tile<Real, Dim, Real, OnTile>(tile, at.material->law, stiffest);
  const Lane<Real>* parts[6] = {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz};
  for (int c = 0; c < 6; ++c) parts[c]->store(tau + c * kLanes);
  return largest(stiffest);
}

/// See LawKernels::deform. Volumes follow from the deformation: nothing corrects them. What bears no tension
/// has empty space beside it where it is larger than at rest, and a point that flies alone would grow for
/// ever, as APIC keeps its velocity gradient: `kOpened`, which says by how much, is bounded.
template <class Real, int Dim, template <class, int, class> class OnTile, Field... kOpened>
void law_deform(const mpm::PointTile<Real>& at, Real dt, const Real* increment) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  Mat3<Lane<Real>> A;
  for (int c = 0; c < 9; ++c) A.m[c / 3][c % 3] = Lane<Real>::load(increment + c * kLanes);
  OnTile<Real, Dim, Real>::deform(tile, at.material->law, false, dt, A);
  [[maybe_unused]] const Lane<Real> most(at.material->most_opened);
  (tile.put(kOpened, 0, min(tile.lane(kOpened), most)), ...);
  if (tile.has(Field::kVelocityGradient))
    for (int c = 0; c < Dim * Dim; ++c)
      tile.put(Field::kVelocityGradient, c, A.m[c / Dim][c % Dim] * (Real(1) / dt));
}

template <class Real, int Dim, template <class, int, class> class OnTile, Field... kOpened>
mpm::LawKernels<Real> kernels_of_law() {
  return {law_stress<Real, Dim, OnTile>, law_deform<Real, Dim, OnTile, kOpened...>};
}

/// In the order of the alternatives of Law.
template <class Real, int Dim>
void fill_laws(mpm::LawKernels<Real> (&laws)[kLaws]) {
  laws[0] = kernels_of_law<Real, Dim, HerschelBulkleyOnTile>();
  laws[1] = kernels_of_law<Real, Dim, NeoHookeanOnTile>();
  laws[2] = kernels_of_law<Real, Dim, DruckerPragerOnTile, Field::kPlasticVolume>();
  laws[3] = kernels_of_law<Real, Dim, SnowOnTile, Field::kPlasticVolume>();
  laws[4] = kernels_of_law<Real, Dim, LiquidOnTile, Field::kVolumeChange>();
}

}  // namespace lather::LATHER_LEVEL
