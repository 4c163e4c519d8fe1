#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/mpm/kernels.h"
#include "sim/particles/block.h"

namespace lather::mpm {

/// A block that holds points: where its buffer collects from and which points of each material it has.
struct PointBlock {
  BlockCoord block{};
  std::array<std::int32_t, 27> grid{};  ///< grid blocks at the 3^dim offsets, last axis fastest
};

/// A block of the grid: some point's stencil may reach it.
struct GridBlock {
  BlockCoord block{};
  std::array<std::int32_t, 27> points{};  ///< point blocks at the 3^dim offsets, -1 where there is none
};

/// The block-sparse grid: only blocks within reach of points exist. Rebuilt whenever points are sorted.
template <class Real>
class BlockGrid {
 public:
  BlockGrid(int dimension, bool apic) : dimension_(dimension), apic_(apic) {}

  /// Blocks for the points of all sets; `ranges[s]` are those of set s. On periodic axes blocks wrap.
  void rebuild(const std::vector<const std::vector<BlockRange>*>& ranges, const CellBounds& bounds,
               int threads);

  [[nodiscard]] const std::vector<PointBlock>& point_blocks() const { return point_blocks_; }
  [[nodiscard]] const std::vector<GridBlock>& grid_blocks() const { return grid_blocks_; }
  /// Index of set s's range in point block b, -1 if it has no points there.
  [[nodiscard]] std::int32_t range_of(std::size_t s, std::size_t b) const { return range_of_[s][b]; }

  [[nodiscard]] Real* momentum_buffer(std::size_t b) { return buffers_.data() + b * buffer_stride(); }
  [[nodiscard]] Real* force_buffer(std::size_t b) {
    return apic_ ? nullptr : momentum_buffer(b) + buffer_reals(dimension_);
  }
  [[nodiscard]] Real* node(std::size_t g) {
    return nodes_.data() + g * static_cast<std::size_t>(block_reals(dimension_));
  }
  [[nodiscard]] const Real* node(std::size_t g) const {
    return nodes_.data() + g * static_cast<std::size_t>(block_reals(dimension_));
  }
  [[nodiscard]] Real* increment(std::size_t g) {
    return apic_ ? nullptr : increments_.data() + g * static_cast<std::size_t>(block_reals(dimension_));
  }
  [[nodiscard]] std::size_t buffer_stride() const {
    return static_cast<std::size_t>(buffer_reals(dimension_)) * (apic_ ? 1 : 2);
  }
  [[nodiscard]] std::size_t bytes() const;

  /// The n-th of the 3^dim blocks around `block` (last axis fastest), wrapped on periodic axes.
  [[nodiscard]] BlockCoord neighbour(const BlockCoord& block, int n, const CellBounds& bounds) const;

  [[nodiscard]] static BlockPlace place(const BlockCoord& block) {
    return {{block[0] * kBlockWidth, block[1] * kBlockWidth, block[2] * kBlockWidth}};
  }

 private:
  [[nodiscard]] BlockCoord wrap(BlockCoord block, const CellBounds& bounds) const;

  int dimension_;
  bool apic_;
  std::vector<PointBlock> point_blocks_;
  std::vector<GridBlock> grid_blocks_;
  std::vector<std::vector<std::int32_t>> range_of_;
  std::vector<Real> buffers_;     // per point block: (m, p), and (0, f) with FLIP
  std::vector<Real> nodes_;       // per grid block: (m, p), then (m, v*)
  std::vector<Real> increments_;  // per grid block: (0, f), then (0, v* - v); FLIP only
};

}  // namespace lather::mpm
