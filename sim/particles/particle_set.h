#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/math/vec.h"
#include "sim/particles/block.h"
#include "sim/plan/tile_layout.h"

namespace lather {

/// Where a point stands in its set: valid until the next sort.
struct PointSlot {
  std::size_t tile = 0;
  int lane = 0;
};

/// Points that left an open domain.
struct Departures {
  std::uint64_t points = 0;
  double shares = 0;  ///< their sum, exact (see Field::kShare)
};

/// The points of one material, in tiles sorted by block (tile_layout.h, block.h). Grown, sorted and compacted
/// here only.
template <class Real>
class ParticleSet {
 public:
  using Word = typename FixedPoint<Real>::Word;

  /// Positions are relative to `origin` in cells of width `cell` (m).
  ParticleSet(int dimension, const std::vector<Field>& fields, const Vec3& origin, double cell);

  /// Appends a point at rest strain, with a whole share: J = 1, be = I. Call sort() before a step reads the
  /// set.
  PointSlot add(const Vec3& position, const Vec3& velocity, const Mat3& velocity_gradient, std::uint32_t id);

  /// Takes a point away; its lane holds nothing until the next sort, which a step must wait for.
  void remove(const PointSlot& slot);

  /// Moves a point to `position` (m). Call sort() before a step reads the set.
  void place(const PointSlot& slot, const Vec3& position);

  /// Sorts by block, wraps periodic axes, drops points that left an open domain. Stable, same result for any
  /// number of threads. Returns what was dropped.
  Departures sort(const CellBounds& bounds, int threads);

  /// After sort(): puts the points of each block in the order of groups of 2 x 2 x 4 cells (2 x 2 in 2D), one
  /// group next to the one before, so that a tile's points lie close together. Stable.
  void order_within_blocks(int threads);

  [[nodiscard]] const std::vector<BlockRange>& ranges() const { return ranges_; }
  [[nodiscard]] const TileLayout& layout() const { return layout_; }
  [[nodiscard]] std::size_t tiles() const {
    return lines_.size() * sizeof(Line) / static_cast<std::size_t>(layout_.stride);
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const { return lines_.size() * sizeof(Line); }

  [[nodiscard]] std::byte* tile(std::size_t t) {
    return reinterpret_cast<std::byte*>(lines_.data()) + t * static_cast<std::size_t>(layout_.stride);
  }
  [[nodiscard]] const std::byte* tile(std::size_t t) const {
    return reinterpret_cast<const std::byte*>(lines_.data()) + t * static_cast<std::size_t>(layout_.stride);
  }

  /// Component `c` of `field` in tile `t`: 16 values.
  template <class T>
  [[nodiscard]] T* values(std::size_t t, Field field, int c = 0) {
    return reinterpret_cast<T*>(tile(t) + layout_.offset[static_cast<int>(field)]) + c * kTile;
  }
  template <class T>
  [[nodiscard]] const T* values(std::size_t t, Field field, int c = 0) const {
    return reinterpret_cast<const T*>(tile(t) + layout_.offset[static_cast<int>(field)]) + c * kTile;
  }

  [[nodiscard]] Vec3 position(std::size_t t, int lane) const;  ///< m; periodic axes wrapped when last sorted
  [[nodiscard]] Vec3 velocity(std::size_t t, int lane) const;  ///< m/s
  /// J - 1. Where kVolumeChange is not planned, from kDeformation and, as J = J_e J_p, kPlasticVolume; 0
  /// without these.
  [[nodiscard]] double volume_change(std::size_t t, int lane) const;
  /// kDeformation: F - I, or F_e - I; in 2D with its zz, and 0 across. 0 where it is not planned.
  [[nodiscard]] Mat3 deformation_change(std::size_t t, int lane) const;
  /// kPlasticVolume: J_p - 1; 0 where it is not planned.
  [[nodiscard]] double plastic_volume_change(std::size_t t, int lane) const {
    return layout_.has(Field::kPlasticVolume)
               ? static_cast<double>(values<Real>(t, Field::kPlasticVolume)[lane])
               : 0.0;
  }
  /// Mass and volume of a point over those of a point as it was sampled; 1 where shares are not planned.
  [[nodiscard]] double share(std::size_t t, int lane) const {
    return layout_.has(Field::kShare) ? static_cast<double>(values<Real>(t, Field::kShare)[lane]) : 1.0;
  }

  /// The raw state for a checkpoint, and back.
  void save(std::string& to) const;
  void restore(const char*& from, const char* end);

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  struct Chunk;

  [[nodiscard]] int group_of(std::size_t t, int lane, const BlockCoord& block) const;
  std::uint64_t key_of(std::size_t t, int lane, const CellBounds& bounds);
  void copy_point(std::byte* to_tile, int to_lane, const std::byte* from_tile, int from_lane) const;
  void fill_empty_lanes(std::size_t range);

  int dimension_;
  Vec3 origin_;
  double cell_;
  TileLayout layout_;
  std::vector<Line> lines_;
  std::vector<BlockRange> ranges_;
  std::uint64_t size_ = 0;
  std::uint64_t next_ = 0;  // the lane that add() fills: the end of the sorted tiles and of what came after
};

}  // namespace lather
