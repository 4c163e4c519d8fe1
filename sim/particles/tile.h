#pragma once

// Lanes of a tile's fields. Compiled per kernel level.

#include "sim/material/herschel_bulkley.h"
#include "sim/plan/tile_layout.h"

namespace lather::LATHER_LEVEL {

/// One tile seen as lanes; `Dim` components of vectors.
template <class Real, int Dim>
struct Tile {
  std::byte* at;
  const TileLayout* layout;

  static constexpr int kStrainComponents = Dim == 3 ? 6 : 4;
  using Word = typename FixedPoint<Real>::Word;

  template <class T>
  T* field(Field f, int component = 0) const {
    return reinterpret_cast<T*>(at + layout->offset[static_cast<int>(f)]) + component * kLanes;
  }
  Lane<Real> lane(Field f, int component = 0) const { return Lane<Real>::load(field<Real>(f, component)); }
  void put(Field f, int component, const Lane<Real>& value) const { value.store(field<Real>(f, component)); }
  bool has(Field f) const { return layout->has(f); }
  const std::int16_t* cell(int axis) const { return field<std::int16_t>(Field::kCell, axis); }

  /// Fraction of the cell, 0 … 1, along an axis.
  Lane<Real> fraction(int axis) const {
    const Word* q = field<Word>(Field::kFraction, axis);
    Real f[kLanes];
    for (int k = 0; k < kLanes; ++k) f[k] = static_cast<Real>(q[k]);
    constexpr Real kQuantum = Real(1) / Real(std::int64_t{1} << FixedPoint<Real>::kBits);
    return Lane<Real>::load(f) * kQuantum;
  }
};

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

template <class Real, int Dim>
inline void store_state(const Tile<Real, Dim>& tile, const HerschelBulkleyState<Lane<Real>>& s) {
  tile.put(Field::kVolumeChange, 0, s.volume_change);
  tile.put(Field::kElasticStrain, 0, s.strain.xx);
  tile.put(Field::kElasticStrain, 1, s.strain.yy);
  tile.put(Field::kElasticStrain, 2, s.strain.zz);
  tile.put(Field::kElasticStrain, 3, s.strain.xy);
  if constexpr (Dim == 3) {
    tile.put(Field::kElasticStrain, 4, s.strain.xz);
    tile.put(Field::kElasticStrain, 5, s.strain.yz);
  }
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

/// x += dt v on one axis of a tile, in fixed point [Foam E.3 step 14, Algorithm 17].
///
/// The displacement is rounded to quanta as floor(d + phase) with the same phase for all points of a step,
/// the phases of successive steps being equidistributed (multiples of the golden ratio). So even a point that
/// moves a fraction of a quantum per step travels as far as it should, within a quantum or two for good; a
/// point at rest stays; a rigid translation stays rigid. `cells` must lie in [-1, 1].
template <class Real, int Dim>
inline void move(const Tile<Real, Dim>& tile, int axis, const Real* cells, Real phase) {
  using Word = typename FixedPoint<Real>::Word;
  constexpr int bits = FixedPoint<Real>::kBits;
  constexpr Real kQuanta = Real(std::int64_t{1} << bits);
  Word* fraction = tile.template field<Word>(Field::kFraction, axis);
  auto* cell = tile.template field<std::int16_t>(Field::kCell, axis);
  for (int k = 0; k < kLanes; ++k) {
    const Real d = cells[k] * kQuanta + phase;
    Word quanta = static_cast<Word>(d);
    quanta -= static_cast<Real>(quanta) > d ? 1 : 0;  // floor
    const Word sum = fraction[k] + quanta;
    cell[k] = static_cast<std::int16_t>(cell[k] + (sum >> bits));
    fraction[k] = sum & ((Word{1} << bits) - 1);
  }
}

}  // namespace lather::LATHER_LEVEL
