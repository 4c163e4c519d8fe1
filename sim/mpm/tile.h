#pragma once

// Lanes of a tile's fields. Compiled per kernel level.

#include "sim/math/lane.h"
#include "sim/mpm/kernels.h"

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

/// The tile of a block's point `first`, a multiple of 16.
template <class Real, int Dim>
inline Tile<Real, Dim> tile_at(const mpm::BlockPoints<Real>& points, int first) {
  return {points.tiles + static_cast<std::ptrdiff_t>(first / kLanes) * points.layout->stride, points.layout};
}

}  // namespace lather::LATHER_LEVEL
