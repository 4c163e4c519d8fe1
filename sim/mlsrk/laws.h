#pragma once

// The laws on tiles of a material's points: which fields each keeps, and how the stages use it. C is the type
// of the constants: Real, or lanes of it where they change with the concentration. Compiled per kernel level.

#include "sim/material/drucker_prager.h"
#include "sim/material/equation_of_state.h"
#include "sim/material/herschel_bulkley.h"
#include "sim/material/neo_hookean.h"
#include "sim/material/newtonian.h"
#include "sim/material/snow.h"
#include "sim/material/volume_correction.h"
#include "sim/mlsrk/kernels.h"
#include "sim/mlsrk/law_constants.h"
#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// dt L, with zeros across the plane in 2D.
template <class Real, int Dim>
inline Mat3<Lane<Real>> deformation_increment(Real dt, const Real* gradient) {
  Mat3<Lane<Real>> A;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      A.m[a][b] =
          a < Dim && b < Dim ? Lane<Real>::load(gradient + (a * Dim + b) * kLanes) * dt : Lane<Real>(Real(0));
  return A;
}

/// (I + A)(I + G) - I
template <class T>
inline Mat3<T> deformed_further(const Mat3<T>& A, const Mat3<T>& G) {
  return sum(sum(A, G), product(A, G));
}

template <class Real, int Dim, class C>
struct HerschelBulkleyOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return tile.lane(Field::kVolumeChange); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, T&) {
    return kirchhoff_stress(load_state(tile), m.herschel_bulkley);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, bool, Real dt,
                     const Mat3<T>& A) {
    HerschelBulkleyState<T> s = predict_elastic(load_state(tile), A);
    const T plastic = correct_plastic(s, m.herschel_bulkley, dt);
    store_state(tile, s);
    if (tile.has(Field::kPlasticStrain))
      tile.put(Field::kPlasticStrain, 0, tile.lane(Field::kPlasticStrain) + plastic);
  }
};

template <class Real, int Dim, class C>
struct NeoHookeanOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return det_minus_one(load_deformation(tile)); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, T&) {
    return kirchhoff_stress(load_deformation(tile), m.elastic);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>&, bool, Real,
                     const Mat3<T>& A) {
    store_deformation(tile, deformed_further(A, load_deformation(tile)));
  }
};

/// Solids with a plastic part: their volume is J_e J_p, their moduli harden.
template <class Real, int Dim>
struct ElastoplasticOnTile {
  using T = Lane<Real>;
  static ElastoplasticState<T> load(const Tile<Real, Dim>& tile) {
    return {load_deformation(tile), tile.lane(Field::kPlasticVolume)};
  }
  static void store(const Tile<Real, Dim>& tile, const ElastoplasticState<T>& s) {
    store_deformation(tile, s.deformation);
    tile.put(Field::kPlasticVolume, 0, s.plastic_volume);
  }
  static T volume_change(const Tile<Real, Dim>& tile) {
    const ElastoplasticState<T> s = load(tile);
    const T elastic = det_minus_one(s.deformation);
    return elastic + s.plastic_volume + elastic * s.plastic_volume;
  }
  template <class C>
  static Sym3<T> hardened(const Tile<Real, Dim>& tile, const NeoHookeanConstants<C>& c, const C& xi,
                          T& stiffest) {
    const ElastoplasticState<T> s = load(tile);
    const T factor = hardening(s.plastic_volume, xi);
    stiffest = max(factor, stiffest);
    return scale(kirchhoff_stress(s.deformation, c), factor);
  }
};

template <class Real, int Dim, class C>
struct SnowOnTile : ElastoplasticOnTile<Real, Dim> {
  using T = Lane<Real>;
  using Base = ElastoplasticOnTile<Real, Dim>;
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, T& stiffest) {
    return Base::hardened(tile, m.elastic, m.snow.hardening, stiffest);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, bool, Real,
                     const Mat3<T>& A) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = deformed_further(A, s.deformation);
    correct_plastic<Dim>(s, m.snow);
    Base::store(tile, s);
  }
};

template <class Real, int Dim, class C>
struct DruckerPragerOnTile : ElastoplasticOnTile<Real, Dim> {
  using T = Lane<Real>;
  using Base = ElastoplasticOnTile<Real, Dim>;
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, T& stiffest) {
    return Base::hardened(tile, m.elastic, m.drucker_prager.hardening, stiffest);
  }
  /// With the correction the return mapping waits for the volume that it is to see.
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, bool corrected, Real,
                     const Mat3<T>& A) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = deformed_further(A, s.deformation);
    if (!corrected) correct_plastic<Dim>(s, m.drucker_prager);
    Base::store(tile, s);
  }
  static void correct(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, const T& change) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = volume_corrected<Dim>(s.deformation, change, s.plastic_volume);
    correct_plastic<Dim>(s, m.drucker_prager);
    Base::store(tile, s);
  }
};

template <class Real, int Dim, class C>
struct LiquidOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return tile.lane(Field::kVolumeChange); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>& m, T&) {
    const T zero(Real(0));
    const T j = volume_change(tile);
    return add_isotropic(Sym3<T>{zero, zero, zero, zero, zero, zero}, -pressure(j, m.liquid) * (j + Real(1)));
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>&, bool, Real,
                     const Mat3<T>& A) {
    const T j = volume_change(tile);
    const T d = det_minus_one(A);
    tile.put(Field::kVolumeChange, 0, j + d + j * d);
  }
  static void correct(const Tile<Real, Dim>& tile, const mlsrk::LawConstants<C>&, const T& change) {
    tile.put(Field::kVolumeChange, 0, change);
  }
};

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
  const mlsrk::LawConstants<C>& m = law_constants<C>(tile, *at.material);
  OnTile<Real, Dim, C>::correct(tile, m, T::load(change));
}

/// V sigma = V0 J_r tau + V sigma_v: elastic and viscous stress add up [MLSRK section 4.3]; the elastic
/// energy is one per volume at rest, as swollen [MLSRK eq. 30].
template <class Real, int Dim, class C, template <class, int, class> class OnTile>
Real stress_rows(const mlsrk::SetTile<Real>& at, Real* rows) {
  using T = Lane<Real>;
  using Law = OnTile<Real, Dim, C>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const mlsrk::LawConstants<C>& m = law_constants<C>(tile, *at.material);
  const T rest_volume = T(m.swelling) * at.material->volume;
  T stiffest(Real(1));
  Sym3<T> s = scale(Law::kirchhoff(tile, m, stiffest), rest_volume);
  if (tile.has(Field::kVelocityGradient)) {
    const Mat3<T> L =
        deformation_increment<Real, Dim>(Real(1), tile.template field<Real>(Field::kVelocityGradient));
    const T volume = (Law::volume_change(tile) + Real(1)) * rest_volume;
    const Sym3<T> v = scale(viscous_stress<Dim>(L, m.viscous), volume);
    s = {s.xx + v.xx, s.yy + v.yy, s.zz + v.zz, s.xy + v.xy, s.xz + v.xz, s.yz + v.yz};
  }
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
  stiffest.store(lanes);
  Real most = Real(1);
  for (const Real l : lanes) most = l > most ? l : most;
  return most;
}

template <class Real, int Dim, class C, template <class, int, class> class OnTile>
void deform(const mlsrk::SetTile<Real>& at, Real dt, const Real* gradient) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  OnTile<Real, Dim, C>::deform(tile, law_constants<C>(tile, *at.material), at.material->corrected, dt,
                               deformation_increment<Real, Dim>(dt, gradient));
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
void fill_laws(mlsrk::LawKernels<Real> (&laws)[mlsrk::kLaws]) {
  laws[0] = law_kernels<Real, Dim, C, HerschelBulkleyOnTile>();
  laws[1] = law_kernels<Real, Dim, C, NeoHookeanOnTile>();
  laws[2] = law_kernels<Real, Dim, C, DruckerPragerOnTile>();
  laws[3] = law_kernels<Real, Dim, C, SnowOnTile>();
  laws[4] = law_kernels<Real, Dim, C, LiquidOnTile>();
  laws[2].correct = correct<Real, Dim, C, DruckerPragerOnTile>;
  laws[4].correct = correct<Real, Dim, C, LiquidOnTile>;
}

}  // namespace lather::LATHER_LEVEL
