#pragma once

// The laws as the stages of this solver use them. C is the type of the constants: Real, or lanes of it where
// they change with the concentration. Compiled per kernel level.

#include "sim/mlsrk/kernels.h"
#include "sim/mlsrk/law_constants.h"
#include "sim/particles/laws_on_tiles.h"

namespace lather::LATHER_LEVEL {

/// V/V0 - 1 by the volume ratio that the law sees, J, and the one at rest, J_r.
template <class T, class C>
inline T swollen(const T& j, const C& J_r) {
  return j + (J_r - C(1)) * (j + C(1));
}

template <class Real, int Dim, class C, template <class, int, class> class OnTile>
void volumes(const mlsrk::SetTile<Real>& at, Real* volume) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  T own = OnTile<Real, Dim, C>::volume_change(tile);
  if (at.material->corrected) own = min(own, T(Real(0)));
  const T change = swollen(own, law_constants<C>(tile, *at.material).swelling);
  ((change + Real(1)) * at.material->volume).store(volume);
}

template <class Real, int Dim, class C>
void swelling(const mlsrk::SetTile<Real>& at, Real* ratio) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  Lane<Real>(law_constants<C>(tile, *at.material).swelling).store(ratio);
}

template <class Real, int Dim, class C, template <class, int, class> class OnTile>
void correct(const mlsrk::SetTile<Real>& at, const Real* change) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const LawConstants<C>& m = law_constants<C>(tile, *at.material);
  OnTile<Real, Dim, C>::correct(tile, m, T::load(change));
}

/// V sigma = V0 J_r (tau + J sigma_v): the elastic energy is one per volume at rest, as swollen [MLSRK eq.
/// 30].
template <class Real, int Dim, class C, template <class, int, class> class OnTile>
Real stress_rows(const mlsrk::SetTile<Real>& at, Real* rows) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const LawConstants<C>& m = law_constants<C>(tile, *at.material);
  T stiffest(Real(1));
  const Sym3<T> s =
      scale(stress_of_tile<Real, Dim, C, OnTile>(tile, m, stiffest), T(m.swelling) * at.material->volume);
  const T* parts[6] = {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz};
  Real lanes[kLanes];
  for (int c = 0; c < 6; ++c) {
    parts[c]->store(lanes);
    for (int k = 0; k < kLanes; ++k) rows[k * mlsrk::kStressReals + c] = lanes[k];
  }
  for (int k = 0; k < kLanes; ++k) {
    rows[k * mlsrk::kStressReals + 6] = Real(0);
    rows[k * mlsrk::kStressReals + 7] = at.material->mass;
  }
  return largest(stiffest);
}

template <class Real, int Dim, class C, template <class, int, class> class OnTile>
void deform(const mlsrk::SetTile<Real>& at, Real dt, const Real* gradient) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  OnTile<Real, Dim, C>::deform(tile, law_constants<C>(tile, *at.material), at.material->corrected, dt,
                               scaled_rows<Real, Dim>(gradient, dt));
  if (tile.has(Field::kVelocityGradient))
    for (int c = 0; c < Dim * Dim; ++c)
      tile.put(Field::kVelocityGradient, c, Lane<Real>::load(gradient + c * kLanes));
}

template <class Real, int Dim, class C, template <class, int, class> class OnTile>
mlsrk::LawKernels<Real> law_kernels() {
  return {
      volumes<Real, Dim, C, OnTile>,     swelling<Real, Dim, C>,       nullptr,
      stress_rows<Real, Dim, C, OnTile>, deform<Real, Dim, C, OnTile>, change_concentration<Real, Dim, C>};
}

/// In the order of the alternatives of Law.
template <class Real, int Dim, class C>
void fill_laws(mlsrk::LawKernels<Real> (&laws)[kLaws]) {
  laws[0] = law_kernels<Real, Dim, C, HerschelBulkleyOnTile>();
  laws[1] = law_kernels<Real, Dim, C, NeoHookeanOnTile>();
  laws[2] = law_kernels<Real, Dim, C, DruckerPragerOnTile>();
  laws[3] = law_kernels<Real, Dim, C, SnowOnTile>();
  laws[4] = law_kernels<Real, Dim, C, LiquidOnTile>();
  laws[2].correct = correct<Real, Dim, C, DruckerPragerOnTile>;
  laws[4].correct = correct<Real, Dim, C, LiquidOnTile>;
}

}  // namespace lather::LATHER_LEVEL
