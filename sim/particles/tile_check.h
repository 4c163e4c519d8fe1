#pragma once

// Whether what a tile's points hold is sound. Compiled per kernel level.

#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// J - 1, or that of F_e where no J is kept. Adds x - x, which is 0 for finite x only, of everything that the
/// points' law keeps to `suspect`: no maximum could hide a NaN there.
template <class Real, int Dim>
inline Lane<Real> checked_volume_change(const Tile<Real, Dim>& tile, Lane<Real>& suspect) {
  const auto check = [&](const Lane<Real>& x) { suspect += x - x; };
  if (tile.has(Field::kElasticStrain))
    for (int c = 0; c < Tile<Real, Dim>::kStrainComponents; ++c) check(tile.lane(Field::kElasticStrain, c));
  if (tile.has(Field::kPlasticVolume)) check(tile.lane(Field::kPlasticVolume));
  if (tile.has(Field::kDeformation))
    for_deformation<Dim>([&](int c, int, int) { check(tile.lane(Field::kDeformation, c)); });
  const Lane<Real> j = tile.has(Field::kVolumeChange) ? tile.lane(Field::kVolumeChange)
                                                      : det_minus_one(load_deformation(tile));
  check(j);
  return j;
}

}  // namespace lather::LATHER_LEVEL
