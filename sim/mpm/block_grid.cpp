#include "sim/mpm/block_grid.h"

#include <algorithm>

#include "sim/math/parallel.h"

namespace lather::mpm {
namespace {

std::vector<std::uint64_t> sorted_unique(std::vector<std::uint64_t> keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

std::int32_t find(const std::vector<std::uint64_t>& keys, std::uint64_t key) {
  const auto at = std::lower_bound(keys.begin(), keys.end(), key);
  return at != keys.end() && *at == key ? static_cast<std::int32_t>(at - keys.begin()) : -1;
}

}  // namespace

template <class Real>
BlockCoord BlockGrid<Real>::wrap(BlockCoord block, const CellBounds& bounds) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (bounds.periodic[a]) {
      const std::int32_t n = bounds.cells[a] / kBlockWidth;
      block[a] = ((block[a] % n) + n) % n;
    }
  return block;
}

template <class Real>
BlockCoord BlockGrid<Real>::neighbour(const BlockCoord& block, int n, const CellBounds& bounds) const {
  BlockCoord b = block;
  for (int a = dimension_ - 1; a >= 0; --a) {
    b[static_cast<std::size_t>(a)] += n % 3 - 1;
    n /= 3;
  }
  return wrap(b, bounds);
}

template <class Real>
void BlockGrid<Real>::rebuild(const std::vector<const std::vector<BlockRange>*>& ranges,
                              const CellBounds& bounds, int threads) {
  const int count = neighbours(dimension_);
  std::vector<std::uint64_t> point_keys;
  for (const auto* set : ranges)
    for (const BlockRange& r : *set) point_keys.push_back(block_key(r.block));
  point_keys = sorted_unique(std::move(point_keys));

  std::vector<std::uint64_t> grid_keys;
  grid_keys.reserve(point_keys.size() * static_cast<std::size_t>(count));
  for (const std::uint64_t key : point_keys)
    for (int n = 0; n < count; ++n) grid_keys.push_back(block_key(neighbour(block_of_key(key), n, bounds)));
  grid_keys = sorted_unique(std::move(grid_keys));

  point_blocks_.resize(point_keys.size());
  parallel_for(threads, static_cast<std::int64_t>(point_keys.size()), 64, [&](std::int64_t i) {
    PointBlock& p = point_blocks_[static_cast<std::size_t>(i)];
    p.block = block_of_key(point_keys[static_cast<std::size_t>(i)]);
    for (int n = 0; n < count; ++n)
      p.grid[static_cast<std::size_t>(n)] = find(grid_keys, block_key(neighbour(p.block, n, bounds)));
  });
  grid_blocks_.resize(grid_keys.size());
  parallel_for(threads, static_cast<std::int64_t>(grid_keys.size()), 64, [&](std::int64_t i) {
    GridBlock& g = grid_blocks_[static_cast<std::size_t>(i)];
    g.block = block_of_key(grid_keys[static_cast<std::size_t>(i)]);
    for (int n = 0; n < count; ++n)
      g.points[static_cast<std::size_t>(n)] = find(point_keys, block_key(neighbour(g.block, n, bounds)));
  });
  range_of_.assign(ranges.size(), {});
  for (std::size_t s = 0; s < ranges.size(); ++s) {
    range_of_[s].assign(point_keys.size(), -1);
    for (std::size_t r = 0; r < ranges[s]->size(); ++r)
      range_of_[s][static_cast<std::size_t>(find(point_keys, block_key((*ranges[s])[r].block)))] =
          static_cast<std::int32_t>(r);
  }
  buffers_.resize(point_blocks_.size() * buffer_stride());
  nodes_.resize(grid_blocks_.size() * static_cast<std::size_t>(block_reals(dimension_)));
  if (!apic_) increments_.resize(nodes_.size());
}

template <class Real>
std::size_t BlockGrid<Real>::bytes() const {
  std::size_t index = 0;
  for (const auto& r : range_of_) index += r.capacity() * sizeof(std::int32_t);
  return (buffers_.capacity() + nodes_.capacity() + increments_.capacity()) * sizeof(Real) +
         point_blocks_.capacity() * sizeof(PointBlock) + grid_blocks_.capacity() * sizeof(GridBlock) + index;
}

template class BlockGrid<float>;
template class BlockGrid<double>;

}  // namespace lather::mpm
