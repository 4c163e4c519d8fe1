#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/plan/tile_layout.h"
#include "sim/scene/scene.h"

/// Blocks of 4 cells per axis, by which points are sorted and the grid is allocated.
namespace lather {

using BlockCoord = std::array<std::int32_t, 3>;  ///< unused axes are 0

/// Orders blocks by x, then y, then z; coordinates within ±2^20.
constexpr std::uint64_t block_key(const BlockCoord& b) {
  constexpr std::int64_t kBias = 1 << 20;
  return (static_cast<std::uint64_t>(b[0] + kBias) << 42U) |
         (static_cast<std::uint64_t>(b[1] + kBias) << 21U) | static_cast<std::uint64_t>(b[2] + kBias);
}

constexpr BlockCoord block_of_key(std::uint64_t key) {
  constexpr std::int64_t kBias = 1 << 20;
  constexpr std::uint64_t kMask = (1U << 21U) - 1;
  return {static_cast<std::int32_t>(static_cast<std::int64_t>((key >> 42U) & kMask) - kBias),
          static_cast<std::int32_t>(static_cast<std::int64_t>((key >> 21U) & kMask) - kBias),
          static_cast<std::int32_t>(static_cast<std::int64_t>(key & kMask) - kBias)};
}

/// The points of one set in one block: whole tiles, the last one perhaps with empty lanes.
struct BlockRange {
  BlockCoord block{};
  std::int32_t first_tile = 0;
  std::int32_t count = 0;  ///< points

  /// The tile of the range's i-th point; its lane is i % kTile.
  [[nodiscard]] std::size_t tile_of(std::int32_t i) const {
    return static_cast<std::size_t>(first_tile) + static_cast<std::size_t>(i / kTile);
  }
};

/// The box of cells that points may be in, and what happens at its faces when points are sorted.
struct CellBounds {
  int dimension = 3;
  std::array<std::int32_t, 3> cells{};  ///< of the domain, per axis, rounded up
  std::array<bool, 3> periodic{};       ///< there, points are wrapped
  bool open = false;                    ///< points outside the other faces are removed
};

[[nodiscard]] CellBounds cell_bounds(const Scene& scene);

/// Which block a point belongs to: block b holds the positions 4b - 1/2 <= x/h < 4b + 7/2, so that a point
/// may drift half a cell to either side before its cubic stencil leaves the block's buffer (a whole cell with
/// quadratic kernels).
inline constexpr double kHomeShift = 0.5;

}  // namespace lather
