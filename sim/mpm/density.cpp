#include "sim/mpm/density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lather::mpm {
namespace {

/// Which cells of a grid block hold a point: one bit a cell, last axis fastest.
using CellBits = std::uint64_t;

int cell_bit(const int (&cell)[3], int dim) {
  int bit = 0;
  for (int a = 0; a < dim; ++a) bit = bit * kBlockWidth + (cell[a] & (kBlockWidth - 1));
  return bit;
}

/// Index of the grid block that holds cell `cell` relative to point block `block`: one of its 3^dim
/// neighbours.
std::int32_t block_of_cell(const PointBlock& block, const int (&cell)[3], int dim) {
  int n = 0;
  for (int a = 0; a < dim; ++a) {
    const int offset = (cell[a] >> 2) - block.block[static_cast<std::size_t>(a)];
    n = n * 3 + std::clamp(offset, -1, 1) + 1;
  }
  return block.grid[static_cast<std::size_t>(n)];
}

template <class Real>
std::vector<CellBits> occupied_cells(const BlockGrid<Real>& grid, const State<Real>& state, int dim) {
  std::vector<CellBits> bits(grid.grid_blocks().size(), 0);
  for (std::size_t b = 0; b < grid.point_blocks().size(); ++b)
    for (std::size_t s = 0; s < state.sets.size(); ++s) {
      if (grid.range_of(s, b) < 0) continue;
      const ParticleSet<Real>& set = state.sets[s];
      const BlockRange& range = set.ranges()[static_cast<std::size_t>(grid.range_of(s, b))];
      for (int i = 0; i < range.count; ++i) {
        int cell[3] = {};
        for (int a = 0; a < dim; ++a)
          cell[a] = set.template values<std::int16_t>(range.tile_of(i), Field::kCell, a)[i % kTile];
        const std::int32_t g = block_of_cell(grid.point_blocks()[b], cell, dim);
        bits[static_cast<std::size_t>(g)] |= CellBits{1} << static_cast<unsigned>(cell_bit(cell, dim));
      }
    }
  return bits;
}

/// The cells of the 3^dim grid blocks around a grid block, last axis fastest; empty where there is no block.
template <class Real>
class CellsAround {
 public:
  CellsAround(const BlockGrid<Real>& grid, const std::vector<CellBits>& cells, const CellBounds& bounds)
      : grid_(grid), cells_(cells), bounds_(bounds) {
    for (const GridBlock& g : grid.grid_blocks()) keys_.push_back(block_key(g.block));
  }

  void look(std::size_t block) {
    for (int n = 0; n < neighbours(bounds_.dimension); ++n) {
      const std::uint64_t key = block_key(grid_.neighbour(grid_.grid_blocks()[block].block, n, bounds_));
      const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
      around_[static_cast<std::size_t>(n)] =
          found != keys_.end() && *found == key ? cells_[static_cast<std::size_t>(found - keys_.begin())] : 0;
    }
  }

  /// True when all cells under the kernel of the block's node, two to either side of it, hold a point.
  [[nodiscard]] bool interior(int node) const {
    const int dim = bounds_.dimension;
    int local[3] = {};
    for (int a = dim - 1; a >= 0; --a) {
      local[a] = node % kBlockWidth;
      node /= kBlockWidth;
    }
    for (int i = 0; i < power(4, dim); ++i) {
      int cell[3] = {};
      int block = 0;
      int digits = i;
      for (int a = dim - 1; a >= 0; --a) {
        cell[a] = local[a] - 2 + digits % 4;
        digits /= 4;
      }
      for (int a = 0; a < dim; ++a) block = block * 3 + (cell[a] >> 2) + 1;
      if ((around_[static_cast<std::size_t>(block)] >> static_cast<unsigned>(cell_bit(cell, dim)) & 1U) == 0)
        return false;
    }
    return true;
  }

 private:
  const BlockGrid<Real>& grid_;
  const std::vector<CellBits>& cells_;
  const CellBounds& bounds_;
  std::vector<std::uint64_t> keys_;
  std::array<CellBits, 27> around_{};
};

}  // namespace

template <class Real>
void measure_density(Stepper<Real>& stepper, State<Real>& state, const Model<Real>& model,
                     FrameMeasure& measure) {
  stepper.sort_when_drifted(state);
  stepper.rasterize_volume_fraction(state);
  const BlockGrid<Real>& grid = stepper.grid();
  const int dim = model.scene.dimension;
  const std::vector<CellBits> cells = occupied_cells(grid, state, dim);
  CellsAround<Real> around(grid, cells, model.bounds);

  double sum = 0;
  measure.density_min = 1e300;
  measure.density_max = 0;
  std::vector<double> values;
  for (std::size_t g = 0; g < grid.grid_blocks().size(); ++g) {
    if (cells[g] == 0) continue;  // an interior node has a point in the cell above it
    around.look(g);
    for (int n = 0; n < block_nodes(dim); ++n) {
      if (!around.interior(n)) continue;
      const double value = stepper.volume_fraction(g, n);
      values.push_back(value);
      sum += value;
      measure.density_min = std::min(measure.density_min, value);
      measure.density_max = std::max(measure.density_max, value);
    }
  }
  measure.interior_nodes = values.size();
  if (values.empty()) {
    measure.density_min = 0;
    return;
  }
  measure.density_mean = sum / static_cast<double>(values.size());
  const auto close = std::count_if(values.begin(), values.end(), [&](double v) {
    return std::abs(v - measure.density_mean) <= 0.05 * measure.density_mean;
  });
  measure.density_within_5_percent = static_cast<double>(close) / static_cast<double>(values.size());
}

template void measure_density(Stepper<float>&, State<float>&, const Model<float>&, FrameMeasure&);
template void measure_density(Stepper<double>&, State<double>&, const Model<double>&, FrameMeasure&);

}  // namespace lather::mpm
