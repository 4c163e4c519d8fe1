#pragma once

// Who is within reach of whom. Compiled per kernel level.
//
// In two steps: the points that any of a tile's may reach, moved into the tile's frame and stored one behind
// the other; out of those the neighbours of one point. Of a tile's lattice of 16 points and a support radius
// of 3 spacings the first are 520 (370 with a radial kernel), the second 200 (100); lanes of the sums over
// neighbours have no holes. Lists are made anew in each stage: kept, they would be 2 to 6 kB a point.
//
// The loops over points are `flatten`: what they call is inlined. g++ would not inline all of it where a lane
// is several registers; in double precision a step then takes half as long again.

#include "sim/math/packing.h"
#include "sim/mlsrk/kernels.h"

namespace lather::LATHER_LEVEL {

/// Values of a number of points: a row a field, with room for a lane that begins at the last point.
template <class Real>
struct Rows {
  Real* first;
  std::size_t stride;
  std::int32_t count;

  Real* operator[](int field) const { return first + static_cast<std::size_t>(field) * stride; }
};

/// How far apart boxes and points are along an axis, where they are not.
template <class T, class Real>
inline T gap(const T& low, const T& high, Real other_low, Real other_high) {
  return max(max(low - other_high, T(other_low) - high), T(Real(0)));
}

/// Coordinates, volumes and the first `Others` rows of `other`, [rows][16] a tile, of the points near a tile,
/// in the tile's frame, with a lane of points nowhere at the end; their slots if `Slots`.
template <class T, int Dim, class W, int Others, bool Slots, class Real>
[[gnu::flatten]] Rows<Real> points_near(const mlsrk::Surroundings<Real>& around, const Real* other = nullptr,
                                        int rows = 0) {
  const mlsrk::Extent<Real>& own = around.extents[around.tile];
  std::size_t most = 0;
  for (std::int32_t n = 0; n < around.block_count; ++n)
    most += static_cast<std::size_t>(around.blocks[n].tiles) * kLanes;
  Rows<Real> near = {around.scratch, mlsrk::scratch_stride(most), 0};
  for (std::int32_t n = 0; n < around.block_count; ++n) {
    const mlsrk::NearBlock<Real>& block = around.blocks[n];
    for (std::int32_t t = block.first_tile; t < block.first_tile + block.tiles; ++t) {
      const mlsrk::Extent<Real>& extent = around.extents[t];
      Real apart[Dim];
      for (int a = 0; a < Dim; ++a)
        apart[a] =
            gap(extent.low[a] + block.shift[a], extent.high[a] + block.shift[a], own.low[a], own.high[a]);
      if (!W::reaches(apart)) continue;
      const Real* place = around.place + std::size_t{4} * kLanes * static_cast<std::size_t>(t);
      for (int lane = 0; lane < kLanes; lane += kWidth<T>) {
        T x[Dim];
        T outside[Dim];
        for (int a = 0; a < Dim; ++a) {
          x[a] = load<T>(place + a * kLanes + lane) + block.shift[a];
          outside[a] = gap(x[a], x[a], own.low[a], own.high[a]);
        }
        const Packing<T> kept(W::reaches(outside));
        for (int a = 0; a < Dim; ++a) kept.store(x[a], near[a] + near.count);
        kept.store(load<T>(place + 3 * kLanes + lane), near[Dim] + near.count);
        for (int f = 0; f < Others; ++f)
          kept.store(load<T>(other + (t * rows + f) * kLanes + lane), near[Dim + 1 + f] + near.count);
        if constexpr (Slots)
          kept.store_numbers(static_cast<std::uint32_t>(t * kLanes + lane), around.slots + near.count);
        near.count += kept.count();
      }
    }
  }
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < kLanes; ++k) near[a][near.count + k] = static_cast<Real>(mlsrk::kNowhere);
  return near;
}

/// Memory for the `reader`-th of several lists out of `near`, of `fields` rows each.
template <class Real>
inline Rows<Real> list_of(const Rows<Real>& near, int reader, int fields) {
  const std::size_t stride = mlsrk::scratch_stride(static_cast<std::size_t>(near.count));
  return {near[7] + static_cast<std::size_t>(reader * fields) * stride, stride, 0};
}

/// Fills `list` with those of `near` that are within reach of the tile's point `i`: their offsets from it,
/// volumes and `Others` more fields. Behind them comes a lane of points out of reach, without volume.
template <class T, int Dim, class W, int Others, class Real>
[[gnu::flatten]] void find_neighbours(const mlsrk::Surroundings<Real>& around, const Rows<Real>& near, int i,
                                      Rows<Real>& list) {
  constexpr Real kOutOfReach = 4;
  const Real* x = around.place + std::size_t{4} * kLanes * around.tile + i;
  std::int32_t count = 0;
  for (std::int32_t k = 0; k < near.count; k += kWidth<T>) {
    T xi[Dim];
    for (int a = 0; a < Dim; ++a) xi[a] = load<T>(near[a] + k) - x[a * kLanes];
    const Packing<T> kept(W::reaches(xi));
    for (int a = 0; a < Dim; ++a) kept.store(xi[a], list[a] + count);
    for (int f = Dim; f <= Dim + Others; ++f) kept.store(load<T>(near[f] + k), list[f] + count);
    count += kept.count();
  }
  for (int k = 0; k < kLanes; ++k) {
    for (int a = 0; a < Dim; ++a) list[a][count + k] = kOutOfReach;
    for (int f = Dim; f <= Dim + Others; ++f) list[f][count + k] = Real(0);
  }
  list.count = count;
}

}  // namespace lather::LATHER_LEVEL
