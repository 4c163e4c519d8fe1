#include "sim/mpm/resample/point_bins.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"
#include "sim/plan/seed.h"

namespace lather::mpm::resample {

namespace {

/// Index of the block of that key, -1 if there is none; blocks are in ascending order of their keys.
std::int32_t index_of(const std::vector<GridBlock>& blocks, std::uint64_t key) {
  const auto at =
      std::lower_bound(blocks.begin(), blocks.end(), key,
                       [](const GridBlock& g, std::uint64_t k) { return block_key(g.block) < k; });
  return at != blocks.end() && block_key(at->block) == key ? static_cast<std::int32_t>(at - blocks.begin())
                                                           : -1;
}

}  // namespace

Lattice::Lattice(const Scene& scene)
    : dimension(scene.dimension), origin(scene.domain.box.min), r(point_distance(scene)) {
  const auto per_cell = static_cast<int>(std::lround(scene.spacing / r));
  width = kBlockWidth * per_cell;
  depth = dimension == 3 ? width : 1;
  for (int a = 0; a < dimension; ++a) origin[a] -= kHomeShift * scene.spacing;
}

Vec3 Lattice::world(const BlockCoord& block, const Local& x) const {
  Vec3 at = Vec3::Zero();
  for (int a = 0; a < dimension; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    at[a] = origin[a] + (static_cast<double>(block[axis]) * width + static_cast<double>(x[axis])) * r;
  }
  return at;
}

template <class Real>
PointBins::PointBins(const std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid,
                     const CellBounds& bounds, const Lattice& lattice, int threads)
    : lattice_(lattice),
      blocks_(grid.point_blocks()),
      around_(grid.grid_blocks()),
      beyond_(grid.grid_blocks().size()) {
  parallel_for(threads, static_cast<std::int64_t>(around_.size()), 64, [&](std::int64_t g) {
    const auto block = static_cast<std::size_t>(g);
    for (int n = 0; n < neighbours(lattice.dimension); ++n)
      beyond_[block][static_cast<std::size_t>(n)] =
          index_of(around_, block_key(grid.neighbour(around_[block].block, n, bounds)));
  });
  std::vector<std::uint32_t> begin(blocks_.size() + 1, 0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    begin[b + 1] = begin[b];
    for (std::size_t s = 0; s < sets.size(); ++s)
      if (const std::int32_t range = grid.range_of(s, b); range >= 0)
        begin[b + 1] += static_cast<std::uint32_t>(sets[s].ranges()[static_cast<std::size_t>(range)].count);
  }
  for (auto& x : x_) x.resize(begin.back());
  points_.resize(begin.back());
  start_.resize(blocks_.size() * static_cast<std::size_t>(lattice.cells()) + 1);
  start_.back() = begin.back();
  parallel_for(threads, static_cast<std::int64_t>(blocks_.size()), 4, [&](std::int64_t b) {
    const auto block = static_cast<std::size_t>(b);
    fill(sets, grid, block, begin[block]);
  });
}

/// A stable counting sort of one block's points by cell.
template <class Real>
void PointBins::fill(const std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid,
                     std::size_t block, std::uint32_t begin) {
  constexpr float kQuantum = 1.0F / static_cast<float>(std::int64_t{1} << FixedPoint<Real>::kBits);
  const int dim = lattice_.dimension;
  const float per_cell = static_cast<float>(lattice_.width) / kBlockWidth;
  std::vector<Local> at;
  std::vector<BinnedPoint> points;
  std::vector<std::int32_t> cell;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const std::int32_t index = grid.range_of(s, block);
    if (index < 0) continue;
    const BlockRange& range = sets[s].ranges()[static_cast<std::size_t>(index)];
    for (int i = 0; i < range.count; ++i) {
      const PointSlot slot = {range.tile_of(i), i % kTile};
      Local x = {0, 0, 0};
      int c[3] = {0, 0, 0};
      for (int a = 0; a < dim; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const int whole = sets[s].template values<std::int16_t>(slot.tile, Field::kCell, a)[slot.lane] -
                          kBlockWidth * range.block[axis];
        const auto quanta = sets[s].template values<typename FixedPoint<Real>::Word>(
            slot.tile, Field::kFraction, a)[slot.lane];
        x[axis] = (static_cast<float>(whole) + static_cast<float>(kHomeShift) +
                   static_cast<float>(quanta) * kQuantum) *
                  per_cell;
        c[a] = std::clamp(static_cast<int>(x[axis]), 0, lattice_.width - 1);  // rounding may reach the end
      }
      at.push_back(x);
      points.push_back({slot, sets[s].template values<std::uint32_t>(slot.tile, Field::kId)[slot.lane],
                        static_cast<std::uint8_t>(s)});
      cell.push_back(lattice_.index(c[0], c[1], c[2]));
    }
  }
  const auto cells = static_cast<std::size_t>(lattice_.cells());
  std::vector<std::uint32_t> next(cells + 1, 0);
  for (const std::int32_t c : cell) ++next[static_cast<std::size_t>(c) + 1];
  next[0] = begin;
  for (std::size_t c = 0; c < cells; ++c) next[c + 1] += next[c];
  std::copy(next.begin(), next.end() - 1, start_.begin() + static_cast<std::ptrdiff_t>(block * cells));
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const std::uint32_t to = next[static_cast<std::size_t>(cell[i])]++;
    points_[to] = points[i];
    for (std::size_t a = 0; a < 3; ++a) x_[a][to] = at[i][a];
  }
}

template PointBins::PointBins(const std::vector<ParticleSet<float>>&, const BlockGrid<float>&,
                              const CellBounds&, const Lattice&, int);
template PointBins::PointBins(const std::vector<ParticleSet<double>>&, const BlockGrid<double>&,
                              const CellBounds&, const Lattice&, int);

}  // namespace lather::mpm::resample
