#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/mlsrk/kernels.h"
#include "sim/particles/particle_set.h"
#include "sim/scene/scene.h"

namespace lather::mlsrk {

/// How far a point may drift between two sorts, in spacings: with it the points within reach of a block of 4
/// cells lie in the next blocks for a support radius up to 3 spacings, in the ones after them up to 4.
inline constexpr double kDriftMargin = 0.45;

/// Sixteen points, or the last few, of one block.
struct CloudTile {
  std::int32_t block = 0;  ///< index into Cloud's blocks
  std::int32_t count = 0;
};

/// The points of all materials together, in tiles of 16 by block, and who may reach whom.
///
/// A slot is 16 times the tile plus the lane; rows of the kernels have one entry a slot. Rebuilt when the
/// sets are sorted; refreshed with the points' places in every step. The order of points follows the sets'
/// alone, so that it is the same after a restore.
template <class Real>
class Cloud {
 public:
  explicit Cloud(const Scene& scene);

  /// Tiles, and each block's neighbours, from the sets as they are sorted.
  void build(const std::vector<ParticleSet<Real>>& sets, const CellBounds& bounds);
  /// Takes the points' places. Volumes stay as put_volume() left them.
  void refresh(const std::vector<ParticleSet<Real>>& sets, int threads);

  [[nodiscard]] const std::vector<CloudTile>& tiles() const { return tiles_; }
  [[nodiscard]] std::size_t slots() const { return tiles_.size() * kTile; }
  [[nodiscard]] bool empty() const { return tiles_.empty(); }
  void clear() { tiles_.clear(); }

  /// The slot of a set's point; of an empty lane: some slot, which must not be written.
  [[nodiscard]] std::uint32_t slot_of(std::size_t set, std::size_t tile, int lane) const {
    return slot_of_[set][tile * kTile + static_cast<std::size_t>(lane)];
  }
  /// The current volume of a point, m^dim.
  void put_volume(std::uint32_t slot, Real volume) { place_[at(slot, 3)] = volume * per_volume_; }

  /// What was put there, m^dim.
  [[nodiscard]] Real volume(std::uint32_t slot) const { return place_[at(slot, 3)] / per_volume_; }

  /// World position of a slot's point, m.
  [[nodiscard]] Vec3 position(std::uint32_t slot) const;
  /// Corners of the box around a tile's points, m.
  [[nodiscard]] Box3 box(std::size_t tile) const;

  /// Memory for what is near one tile; one a thread.
  struct Scratch {
    std::vector<Real> reals;
    std::vector<std::uint32_t> slots;
  };
  /// A tile's points and who may be within reach of them, for kernels.
  [[nodiscard]] Surroundings<Real> around(std::size_t tile, Scratch& scratch) const;

  [[nodiscard]] double scale() const { return scale_; }  ///< a = R/2, m
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Block {
    BlockCoord at{};
    std::int32_t first_tile = 0;
    std::int32_t tiles = 0;
    std::int32_t first_neighbour = 0;  ///< into neighbours_, of lengths over a
    std::int32_t neighbours = 0;
  };
  /// A point's set and place in it.
  struct Source {
    std::uint32_t set;
    std::uint32_t index;  ///< 16 tile + lane
  };

  void find_neighbours(const CellBounds& bounds);
  /// Where a slot's coordinate, or with 3 its volume, is in place_.
  [[nodiscard]] static std::size_t at(std::uint32_t slot, int row) {
    return (std::size_t{slot / kTile} * 4 + static_cast<std::size_t>(row)) * kTile + slot % kTile;
  }

  int dimension_;
  Vec3 origin_;
  double spacing_;
  double scale_;
  int reach_;        // blocks
  Real per_volume_;  // a^-dim
  std::vector<Block> blocks_;
  std::vector<NearBlock<Real>> neighbours_;
  std::size_t most_near_ = 0;  // slots of a block's neighbours
  std::vector<CloudTile> tiles_;
  std::vector<Extent<Real>> extents_;
  std::vector<Source> sources_;  // one a slot
  std::vector<std::vector<std::uint32_t>> slot_of_;
  std::vector<Real> place_;  // see Surroundings
};

}  // namespace lather::mlsrk
