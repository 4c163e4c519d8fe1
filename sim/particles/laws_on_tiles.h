#pragma once

// The laws on tiles of a material's points, for both solvers: which fields each keeps, its stress, and what a
// step of deformation does to it. C is the type of the constants: Real, or lanes of it where they change with
// the concentration. Compiled per kernel level.

#include "sim/material/drucker_prager.h"
#include "sim/material/equation_of_state.h"
#include "sim/material/herschel_bulkley.h"
#include "sim/material/law_constants.h"
#include "sim/material/neo_hookean.h"
#include "sim/material/newtonian.h"
#include "sim/material/snow.h"
#include "sim/material/volume_correction.h"
#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// The matrix times `factor` whose rows are [Dim Dim][16], with zeros across the plane in 2D.
template <class Real, int Dim>
inline Mat3<Lane<Real>> scaled_rows(const Real* rows, Real factor) {
  Mat3<Lane<Real>> A;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      A.m[a][b] =
          a < Dim && b < Dim ? Lane<Real>::load(rows + (a * Dim + b) * kLanes) * factor : Lane<Real>(Real(0));
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
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const LawConstants<C>& m, T&) {
    return kirchhoff_stress(load_state(tile), m.herschel_bulkley);
  }
  static void deform(const Tile<Real, Dim>& tile, const LawConstants<C>& m, bool, Real dt, const Mat3<T>& A) {
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
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const LawConstants<C>& m, T&) {
    return kirchhoff_stress(load_deformation(tile), m.elastic);
  }
  static void deform(const Tile<Real, Dim>& tile, const LawConstants<C>&, bool, Real, const Mat3<T>& A) {
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
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const LawConstants<C>& m, T& stiffest) {
    return Base::hardened(tile, m.elastic, m.snow.hardening, stiffest);
  }
  static void deform(const Tile<Real, Dim>& tile, const LawConstants<C>& m, bool, Real, const Mat3<T>& A) {
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
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const LawConstants<C>& m, T& stiffest) {
    return Base::hardened(tile, m.elastic, m.drucker_prager.hardening, stiffest);
  }
  /// With the correction the return mapping waits for the volume that it is to see.
  static void deform(const Tile<Real, Dim>& tile, const LawConstants<C>& m, bool corrected, Real,
                     const Mat3<T>& A) {
    ElastoplasticState<T> s = Base::load(tile);
    s.deformation = deformed_further(A, s.deformation);
    if (!corrected) correct_plastic<Dim>(s, m.drucker_prager);
    Base::store(tile, s);
  }
  static void correct(const Tile<Real, Dim>& tile, const LawConstants<C>& m, const T& change) {
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
  static Sym3<T> kirchhoff(const Tile<Real, Dim>& tile, const LawConstants<C>& m, T&) {
    const T zero(Real(0));
    const T j = volume_change(tile);
    return add_isotropic(Sym3<T>{zero, zero, zero, zero, zero, zero}, -pressure(j, m.liquid) * (j + Real(1)));
  }
  static void deform(const Tile<Real, Dim>& tile, const LawConstants<C>&, bool, Real, const Mat3<T>& A) {
    const T j = volume_change(tile);
    const T d = det_minus_one(A);
    tile.put(Field::kVolumeChange, 0, j + d + j * d);
  }
  static void correct(const Tile<Real, Dim>& tile, const LawConstants<C>&, const T& change) {
    tile.put(Field::kVolumeChange, 0, change);
  }
};

/// Kirchhoff stress tau + J sigma_v, Pa: elastic and viscous stress add up [MLSRK section 4.3]. The velocity
/// gradient is that of the last step. `stiffest` becomes the factor by which moduli are hardened, if larger.
template <class Real, int Dim, class C, template <class, int, class> class OnTile>
inline Sym3<Lane<Real>> stress_of_tile(const Tile<Real, Dim>& tile, const LawConstants<C>& m,
                                       Lane<Real>& stiffest) {
  using T = Lane<Real>;
  using Law = OnTile<Real, Dim, C>;
  const Sym3<T> s = Law::kirchhoff(tile, m, stiffest);
  if (!tile.has(Field::kVelocityGradient)) return s;
  const Mat3<T> L = scaled_rows<Real, Dim>(tile.template field<Real>(Field::kVelocityGradient), Real(1));
  const Sym3<T> v = scale(viscous_stress<Dim>(L, m.viscous), Law::volume_change(tile) + Real(1));
  return {s.xx + v.xx, s.yy + v.yy, s.zz + v.zz, s.xy + v.xy, s.xz + v.xz, s.yz + v.yz};
}

/// The largest of the lanes.
template <class Real>
inline Real largest(const Lane<Real>& values) {
  Real lanes[kLanes];
  values.store(lanes);
  Real most = lanes[0];
  for (const Real l : lanes) most = l > most ? l : most;
  return most;
}

}  // namespace lather::LATHER_LEVEL
