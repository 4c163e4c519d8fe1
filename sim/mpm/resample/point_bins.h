#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/mpm/block_grid.h"
#include "sim/particles/particle_set.h"
#include "sim/scene/scene.h"

/// "Avoid a void" [Foam section 6, Algorithm 18] works on a lattice of cells of width r, the points' initial
/// distance: a whole number of them per cell of the grid, so that a block of the grid is a block here too.
/// All lengths are in units of r, and positions are local: relative to the corner of the block at hand.
namespace lather::mpm::resample {

using Local = std::array<float, 3>;  ///< a position relative to a block's corner, units of r; z is 0 in 2D

/// The lattice of one scene.
struct Lattice {
  int dimension = 3;
  int width = 0;  ///< cells of width r per axis of a block
  int depth = 0;  ///< the same along z: 1 in 2D
  Vec3 origin;    ///< corner of block (0, 0, 0), m: half a grid cell below the domain's (kHomeShift)
  double r = 0;   ///< m

  Lattice() = default;
  explicit Lattice(const Scene& scene);

  [[nodiscard]] int cells() const { return width * width * depth; }  ///< of a block
  /// Index of a block's cell, or of the node at its lower corner; z runs fastest.
  [[nodiscard]] int index(int i, int j, int k) const { return (i * width + j) * depth + k; }
  [[nodiscard]] int extent(int axis) const { return axis == 2 ? depth : width; }
  [[nodiscard]] Vec3 world(const BlockCoord& block, const Local& x) const;  ///< m
  /// Number of the neighbour at `offset` (each -1 … 1) in the lists of PointBlock and GridBlock.
  [[nodiscard]] int neighbour(const std::array<int, 3>& offset) const {
    const int plane = (offset[0] + 1) * 3 + offset[1] + 1;
    return dimension == 3 ? plane * 3 + offset[2] + 1 : plane;
  }
};

/// A point of some material's set.
struct BinnedPoint {
  PointSlot slot;
  std::uint32_t id;
  std::uint8_t set;  ///< which material's
};

/// All points of all materials by lattice cell ("register all spheres into a uniform grid", Algorithm 2).
/// Good until the sets are sorted anew; the sets must just have been sorted and `grid` rebuilt.
class PointBins {
 public:
  template <class Real>
  PointBins(const std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid, const CellBounds& bounds,
            const Lattice& lattice, int threads);

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  [[nodiscard]] const std::vector<PointBlock>& blocks() const { return blocks_; }     ///< with points
  [[nodiscard]] const std::vector<GridBlock>& all_blocks() const { return around_; }  ///< and around those
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const BinnedPoint& point(std::uint32_t p) const { return points_[p]; }
  [[nodiscard]] Local local(std::uint32_t p) const { return {x_[0][p], x_[1][p], x_[2][p]}; }
  [[nodiscard]] float local(std::uint32_t p, int axis) const { return x_[static_cast<std::size_t>(axis)][p]; }

  /// The points of cells `from` to `to` (indices into a block) of point block b are [first, last).
  [[nodiscard]] std::uint32_t first(std::size_t b, int from) const {
    return start_[b * static_cast<std::size_t>(lattice_.cells()) + static_cast<std::size_t>(from)];
  }
  [[nodiscard]] std::uint32_t last(std::size_t b, int to) const { return first(b, to + 1); }

  /// Index of point block b among all blocks.
  [[nodiscard]] std::size_t home(std::size_t b) const {
    return static_cast<std::size_t>(blocks_[b].grid[static_cast<std::size_t>(lattice_.neighbour({0, 0, 0}))]);
  }
  /// The point block at `offset` from point block b, -1 if it has no points.
  [[nodiscard]] std::int32_t neighbour(std::size_t b, const std::array<int, 3>& offset) const {
    return around_[home(b)].points[static_cast<std::size_t>(lattice_.neighbour(offset))];
  }

  /// The block at `offset` from one of all blocks, -1 if there is none.
  [[nodiscard]] std::int32_t beyond(std::size_t block, const std::array<int, 3>& offset) const {
    return beyond_[block][static_cast<std::size_t>(lattice_.neighbour(offset))];
  }

  /// Calls visit(p, x) for the points p of the cells low … high around point block b, both included, x being
  /// relative to b's corner; cells count from that corner and may lie up to a block outside. Fixed order.
  template <class Visit>
  void for_points(std::size_t b, std::array<int, 3> low, std::array<int, 3> high, const Visit& visit) const {
    for_points_around(home(b), low, high, visit);
  }
  /// The same around one of all blocks.
  template <class Visit>
  void for_points_around(std::size_t block, std::array<int, 3> low, std::array<int, 3> high,
                         const Visit& visit) const;
  /// Number of those points around point block b.
  [[nodiscard]] std::uint32_t count_points(std::size_t b, std::array<int, 3> low,
                                           std::array<int, 3> high) const {
    std::uint32_t n = 0;
    for_rows_around(home(b), low, high,
                    [&](std::uint32_t first, std::uint32_t last, const Local&) { n += last - first; });
    return n;
  }

 private:
  /// Calls visit(first, last, shift) for runs of those points; `shift` takes their local positions to the
  /// block's corner.
  template <class Visit>
  void for_rows_around(std::size_t block, std::array<int, 3> low, std::array<int, 3> high,
                       const Visit& visit) const;
  template <class Real>
  void fill(const std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid, std::size_t block,
            std::uint32_t begin);

  Lattice lattice_;
  std::vector<PointBlock> blocks_;
  std::vector<GridBlock> around_;
  std::vector<std::array<std::int32_t, 27>> beyond_;
  std::array<std::vector<float>, 3> x_;  // local
  std::vector<BinnedPoint> points_;
  std::vector<std::uint32_t> start_;  // per block and cell: its first point
};

/// The offsets of neighbouring blocks that the cells low … high reach along an axis of `width` cells.
[[nodiscard]] constexpr std::array<int, 2> block_span(int low, int high, int width) {
  return {low < 0 ? -1 : 0, high >= width ? 1 : 0};
}

template <class Visit>
void PointBins::for_points_around(std::size_t block, std::array<int, 3> low, std::array<int, 3> high,
                                  const Visit& visit) const {
  for_rows_around(block, low, high, [&](std::uint32_t first, std::uint32_t last, const Local& shift) {
    for (std::uint32_t p = first; p < last; ++p)
      visit(p, Local{x_[0][p] + shift[0], x_[1][p] + shift[1], x_[2][p] + shift[2]});
  });
}

template <class Visit>
void PointBins::for_rows_around(std::size_t block, std::array<int, 3> low, std::array<int, 3> high,
                                const Visit& visit) const {
  if (lattice_.dimension == 2) low[2] = high[2] = 0;
  const auto reach = [&](int a) {
    return block_span(low[static_cast<std::size_t>(a)], high[static_cast<std::size_t>(a)],
                      lattice_.extent(a));
  };
  const auto [x0, x1] = reach(0);
  const auto [y0, y1] = reach(1);
  const auto [z0, z1] = reach(2);
  std::array<int, 3> o{};
  for (o[0] = x0; o[0] <= x1; ++o[0])
    for (o[1] = y0; o[1] <= y1; ++o[1])
      for (o[2] = z0; o[2] <= z1; ++o[2]) {
        const std::int32_t found = around_[block].points[static_cast<std::size_t>(lattice_.neighbour(o))];
        if (found < 0) continue;
        const auto from = static_cast<std::size_t>(found);
        int first_cell[3];
        int last_cell[3];
        Local shift{};
        for (int a = 0; a < 3; ++a) {
          const auto axis = static_cast<std::size_t>(a);
          const int n = lattice_.extent(a);
          first_cell[a] = std::max(low[axis] - o[axis] * n, 0);
          last_cell[a] = std::min(high[axis] - o[axis] * n, n - 1);
          shift[axis] = static_cast<float>(o[axis] * n);
        }
        for (int i = first_cell[0]; i <= last_cell[0]; ++i)
          for (int j = first_cell[1]; j <= last_cell[1]; ++j)
            visit(first(from, lattice_.index(i, j, first_cell[2])),
                  last(from, lattice_.index(i, j, last_cell[2])), shift);
      }
}

}  // namespace lather::mpm::resample
