#pragma once

// The laws on tiles of a material's points: which fields each keeps, and how the stages use it. Compiled per
// kernel level.

#include "sim/material/drucker_prager.h"
#include "sim/material/equation_of_state.h"
#include "sim/material/herschel_bulkley.h"
#include "sim/material/neo_hookean.h"
#include "sim/material/newtonian.h"
#include "sim/material/snow.h"
#include "sim/material/volume_correction.h"
#include "sim/mlsrk/kernels.h"
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

template <class Real, int Dim>
struct HerschelBulkleyOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return tile.lane(Field::kVolumeChange); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, T&) {
    return kirchhoff_stress(load_state(tile), m.herschel_bulkley);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, Real dt,
                     const Mat3<T>& A) {
    HerschelBulkleyState<T> s = predict_elastic(load_state(tile), A);
    const T plastic = correct_plastic(s, m.herschel_bulkley, dt);
    store_state(tile, s);
    if (tile.has(Field::kPlasticStrain))
      tile.put(Field::kPlasticStrain, 0, tile.lane(Field::kPlasticStrain) + plastic);
  }
};

template <class Real, int Dim>
struct NeoHookeanOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return det_minus_one(load_deformation(tile)); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, T&) {
    return kirchhoff_stress(load_deformation(tile), m.elastic);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>&, Real,
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
  static Sym3<T> hardened(const Tile<Real, Dim>& tile, const NeoHookeanConstants<Real>& c, Real xi,
                          T& stiffest) {
    const ElastoplasticState<T> s = load(tile);
    const T factor = hardening(s.plastic_volume, xi);
    stiffest = max(factor, stiffest);
    return scale(kirchhoff_stress(s.deformation, c), factor);
  }
};

template <class Real, int Dim>
struct SnowOnTile : ElastoplasticOnTile<Real, Dim> {
  using T = Lane<Real>;
  using Base = ElastoplasticOnTile<Real, Dim>;
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m,
                           T& stiffest) {
    return Base::hardened(tile, m.elastic, m.snow.hardening, stiffest);
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, Real,
                     const Mat3<T>& A) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = deformed_further(A, s.deformation);
    correct_plastic<Dim>(s, m.snow);
    Base::store(tile, s);
  }
};

template <class Real, int Dim>
struct DruckerPragerOnTile : ElastoplasticOnTile<Real, Dim> {
  using T = Lane<Real>;
  using Base = ElastoplasticOnTile<Real, Dim>;
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m,
                           T& stiffest) {
    return Base::hardened(tile, m.elastic, m.drucker_prager.hardening, stiffest);
  }
  /// With the correction the return mapping waits for the volume that it is to see.
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, Real,
                     const Mat3<T>& A) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = deformed_further(A, s.deformation);
    if (!m.corrected) correct_plastic<Dim>(s, m.drucker_prager);
    Base::store(tile, s);
  }
  static void correct(const mlsrk::SetTile<Real>& at, const Real* change) {
    const Tile<Real, Dim> tile{at.bytes, at.layout};
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = volume_corrected<Dim>(s.deformation, T::load(change), s.plastic_volume);
    correct_plastic<Dim>(s, at.material->drucker_prager);
    Base::store(tile, s);
  }
};

template <class Real, int Dim>
struct LiquidOnTile {
  using T = Lane<Real>;
  static T volume_change(const Tile<Real, Dim>& tile) { return tile.lane(Field::kVolumeChange); }
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m, T&) {
    const T zero(Real(0));
    const T j = volume_change(tile);
    return add_isotropic(Sym3<T>{zero, zero, zero, zero, zero, zero}, -pressure(j, m.liquid) * (j + Real(1)));
  }
  static void deform(const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>&, Real,
                     const Mat3<T>& A) {
    const T j = volume_change(tile);
    const T d = det_minus_one(A);
    tile.put(Field::kVolumeChange, 0, j + d + j * d);
  }
  static void correct(const mlsrk::SetTile<Real>& at, const Real* change) {
    Tile<Real, Dim>{at.bytes, at.layout}.put(Field::kVolumeChange, 0, T::load(change));
  }
};

template <class Real, int Dim, class OnTile>
void volume_changes(const mlsrk::SetTile<Real>& at, Real* change) {
  OnTile::volume_change({at.bytes, at.layout}).store(change);
}

/// V sigma = V0 tau + V sigma_v: elastic and viscous stress add up [MLSRK section 4.3].
template <class Real, int Dim, class OnTile>
Real stress_rows(const mlsrk::SetTile<Real>& at, Real* rows) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  const mlsrk::MaterialConstants<Real>& m = *at.material;
  T stiffest(Real(1));
  Sym3<T> s = scale(OnTile::kirchhoff(tile, m, stiffest), T(m.volume));
  if (tile.has(Field::kVelocityGradient)) {
    const Mat3<T> L =
        deformation_increment<Real, Dim>(Real(1), tile.template field<Real>(Field::kVelocityGradient));
    const T volume = (OnTile::volume_change(tile) + Real(1)) * m.volume;
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
    rows[k * mlsrk::kStressReals + 7] = m.mass;
  }
  stiffest.store(lanes);
  Real most = Real(1);
  for (const Real l : lanes) most = l > most ? l : most;
  return most;
}

template <class Real, int Dim, class OnTile>
void deform(const mlsrk::SetTile<Real>& at, Real dt, const Real* gradient) {
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  OnTile::deform(tile, *at.material, dt, deformation_increment<Real, Dim>(dt, gradient));
  if (tile.has(Field::kVelocityGradient))
    for (int c = 0; c < Dim * Dim; ++c)
      tile.put(Field::kVelocityGradient, c, Lane<Real>::load(gradient + c * kLanes));
}

template <class Real, int Dim, class OnTile>
mlsrk::LawKernels<Real> law_kernels() {
  return {volume_changes<Real, Dim, OnTile>, nullptr, stress_rows<Real, Dim, OnTile>,
          deform<Real, Dim, OnTile>};
}

/// In the order of the alternatives of Law.
template <class Real, int Dim>
void fill_laws(mlsrk::LawKernels<Real> (&laws)[mlsrk::kLaws]) {
  laws[0] = law_kernels<Real, Dim, HerschelBulkleyOnTile<Real, Dim>>();
  laws[1] = law_kernels<Real, Dim, NeoHookeanOnTile<Real, Dim>>();
  laws[2] = law_kernels<Real, Dim, DruckerPragerOnTile<Real, Dim>>();
  laws[3] = law_kernels<Real, Dim, SnowOnTile<Real, Dim>>();
  laws[4] = law_kernels<Real, Dim, LiquidOnTile<Real, Dim>>();
  laws[2].correct = DruckerPragerOnTile<Real, Dim>::correct;
  laws[4].correct = LiquidOnTile<Real, Dim>::correct;
}

}  // namespace lather::LATHER_LEVEL
