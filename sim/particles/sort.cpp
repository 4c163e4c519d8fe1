// Sorting points by block: a stable counting sort over the blocks that are occupied, in chunks of fixed size,
// so that the order never depends on the number of threads.

#include <algorithm>
#include <cstring>
#include <vector>

#include "sim/math/parallel.h"
#include "sim/particles/particle_set.h"

namespace lather {
namespace {

constexpr std::size_t kChunkTiles = 256;
constexpr std::uint64_t kEmpty = ~std::uint64_t{0};  // the key of a lane without a point
constexpr std::uint64_t kLeft = kEmpty - 1;          // … of a point that left the domain

bool dropped(std::uint64_t key) {
  return key >= kLeft;
}

/// Copies one lane of `rows` rows of values of kBytes each.
template <int kBytes>
void copy_lane(std::byte* to, int to_lane, const std::byte* from, int from_lane, int rows) {
  for (int r = 0; r < rows; ++r)
    std::memcpy(to + (r * kTile + to_lane) * kBytes, from + (r * kTile + from_lane) * kBytes, kBytes);
}

std::int32_t floor_mod(std::int32_t a, std::int32_t n) {
  return ((a % n) + n) % n;
}

}  // namespace

/// What one chunk of tiles holds: the key of every lane, and its distinct blocks with where their points go.
template <class Real>
struct ParticleSet<Real>::Chunk {
  std::vector<std::uint64_t> keys;    // one a lane
  std::vector<std::uint64_t> blocks;  // distinct, ascending
  std::vector<std::int64_t> cursor;   // per block: its number of points here, then the slot of the next one
  Departures left;

  std::size_t find(std::uint64_t key) const {
    return static_cast<std::size_t>(std::lower_bound(blocks.begin(), blocks.end(), key) - blocks.begin());
  }
};

template <class Real>
std::uint64_t ParticleSet<Real>::key_of(std::size_t t, int lane, const CellBounds& bounds) {
  if (values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) return kEmpty;
  BlockCoord block{};
  for (int a = 0; a < dimension_; ++a) {
    auto& cell = values<std::int16_t>(t, Field::kCell, a)[lane];
    const Word fraction = values<Word>(t, Field::kFraction, a)[lane];
    const std::int32_t up = fraction >> (FixedPoint<Real>::kBits - 1) ? 1 : 0;  // at or beyond half a cell
    std::int32_t home = cell + up;
    const auto axis = static_cast<std::size_t>(a);
    if (bounds.periodic[axis]) {
      home = floor_mod(home, bounds.cells[axis]);
      cell = static_cast<std::int16_t>(home - up);
    } else if (bounds.open && (cell < 0 || cell >= bounds.cells[axis])) {
      return kLeft;
    }
    block[axis] = home >> 2;
  }
  return block_key(block);
}

template <class Real>
void ParticleSet<Real>::copy_point(std::byte* to_tile, int to_lane, const std::byte* from_tile,
                                   int from_lane) const {
  for (int f = 0; f < kFieldCount; ++f) {
    if (layout_.offset[f] < 0) continue;
    std::byte* to = to_tile + layout_.offset[f];
    const std::byte* from = from_tile + layout_.offset[f];
    const int rows = layout_.components[f];
    switch (layout_.component_bytes[f]) {
      case 2:
        copy_lane<2>(to, to_lane, from, from_lane, rows);
        break;
      case 4:
        copy_lane<4>(to, to_lane, from, from_lane, rows);
        break;
      default:
        copy_lane<8>(to, to_lane, from, from_lane, rows);
    }
  }
}

template <class Real>
void ParticleSet<Real>::fill_empty_lanes(std::size_t range) {
  const BlockRange& r = ranges_[range];
  const int used = r.count % kTile;
  if (used == 0) return;
  const auto t = r.tile_of(r.count);
  for (int lane = used; lane < kTile;
       ++lane) {  // a copy of the tile's first point: finite, and inside the buffer
    copy_point(tile(t), lane, tile(t), 0);
    values<std::uint32_t>(t, Field::kId)[lane] = kNoPoint;
  }
}

template <class Real>
Departures ParticleSet<Real>::sort(const CellBounds& bounds, int threads) {
  const std::size_t tile_count = tiles();
  const std::size_t chunk_count = (tile_count + kChunkTiles - 1) / kChunkTiles;
  std::vector<Chunk> chunks(chunk_count);
  const auto chunk_tiles = [&](std::size_t c) { return std::min(kChunkTiles, tile_count - c * kChunkTiles); };

  // Keys and distinct blocks of each chunk.
  parallel_for(threads, static_cast<std::int64_t>(chunk_count), 1, [&](std::int64_t index) {
    const auto c = static_cast<std::size_t>(index);
    Chunk& chunk = chunks[c];
    chunk.keys.resize(chunk_tiles(c) * kTile);
    std::uint64_t last = kEmpty;
    for (std::size_t i = 0; i < chunk.keys.size(); ++i) {
      const std::size_t t = c * kChunkTiles + i / kTile;
      const auto lane = static_cast<int>(i % kTile);
      const std::uint64_t key = key_of(t, lane, bounds);
      chunk.keys[i] = key;
      if (key != last && !dropped(key)) chunk.blocks.push_back(key);
      if (key == kLeft) ++chunk.left.points, chunk.left.shares += share(t, lane);
      last = key;
    }
    std::sort(chunk.blocks.begin(), chunk.blocks.end());
    chunk.blocks.erase(std::unique(chunk.blocks.begin(), chunk.blocks.end()), chunk.blocks.end());
    chunk.cursor.assign(chunk.blocks.size(), 0);
    std::size_t at = 0;
    for (const std::uint64_t key : chunk.keys) {
      if (dropped(key)) continue;
      if (chunk.blocks[at] != key) at = chunk.find(key);
      ++chunk.cursor[at];
    }
  });

  // All blocks, their points, and where each chunk's share of them starts.
  std::vector<std::uint64_t> blocks;
  for (const Chunk& chunk : chunks) blocks.insert(blocks.end(), chunk.blocks.begin(), chunk.blocks.end());
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  std::vector<BlockRange> ranges(blocks.size());
  const auto index_of = [&](std::uint64_t key) {
    return static_cast<std::size_t>(std::lower_bound(blocks.begin(), blocks.end(), key) - blocks.begin());
  };
  for (const Chunk& chunk : chunks)
    for (std::size_t b = 0; b < chunk.blocks.size(); ++b)
      ranges[index_of(chunk.blocks[b])].count += static_cast<std::int32_t>(chunk.cursor[b]);
  std::vector<std::int64_t> next(blocks.size());
  std::int32_t tile_end = 0;
  std::uint64_t kept = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    ranges[b].block = block_of_key(blocks[b]);
    ranges[b].first_tile = tile_end;
    next[b] = std::int64_t{tile_end} * kTile;
    tile_end += (ranges[b].count + kTile - 1) / kTile;
    kept += static_cast<std::uint64_t>(ranges[b].count);
  }
  for (Chunk& chunk : chunks)
    for (std::size_t b = 0; b < chunk.blocks.size(); ++b) {
      std::int64_t& slot = next[index_of(chunk.blocks[b])];
      const std::int64_t count = chunk.cursor[b];
      chunk.cursor[b] = slot;
      slot += count;
    }

  // Move the points.
  const auto stride = static_cast<std::size_t>(layout_.stride);
  std::vector<Line> sorted(static_cast<std::size_t>(tile_end) * stride / sizeof(Line));
  auto* const sorted_tiles = reinterpret_cast<std::byte*>(sorted.data());
  parallel_for(threads, static_cast<std::int64_t>(chunk_count), 1, [&](std::int64_t index) {
    const auto c = static_cast<std::size_t>(index);
    Chunk& chunk = chunks[c];
    std::size_t at = 0;
    for (std::size_t i = 0; i < chunk.keys.size(); ++i) {
      if (dropped(chunk.keys[i])) continue;
      if (chunk.blocks[at] != chunk.keys[i]) at = chunk.find(chunk.keys[i]);
      const auto slot = static_cast<std::size_t>(chunk.cursor[at]++);
      copy_point(sorted_tiles + slot / kTile * stride, static_cast<int>(slot % kTile),
                 tile(c * kChunkTiles + i / kTile), static_cast<int>(i % kTile));
    }
  });
  lines_ = std::move(sorted);
  ranges_ = std::move(ranges);
  parallel_for(threads, static_cast<std::int64_t>(ranges_.size()), 64,
               [&](std::int64_t r) { fill_empty_lanes(static_cast<std::size_t>(r)); });
  Departures left;
  for (const Chunk& chunk : chunks) left.points += chunk.left.points, left.shares += chunk.left.shares;
  size_ = kept;
  next_ = static_cast<std::uint64_t>(tiles()) * kTile;
  return left;
}

/// 0 … 3, around the block: neighbouring numbers are neighbouring groups.
template <class Real>
int ParticleSet<Real>::group_of(std::size_t t, int lane, const BlockCoord& block) const {
  int upper[2];
  for (int a = 0; a < 2; ++a) {
    const Word fraction = values<Word>(t, Field::kFraction, a)[lane];
    const int home = values<std::int16_t>(t, Field::kCell, a)[lane] +
                     (fraction >> (FixedPoint<Real>::kBits - 1) ? 1 : 0) -
                     4 * block[static_cast<std::size_t>(a)];
    upper[a] = home >= 2 ? 1 : 0;
  }
  return upper[0] == 0 ? upper[1] : 3 - upper[1];
}

template <class Real>
void ParticleSet<Real>::order_within_blocks(int threads) {
  const auto stride = static_cast<std::size_t>(layout_.stride);
  parallel_for(threads, static_cast<std::int64_t>(ranges_.size()), 16, [&](std::int64_t r) {
    const BlockRange& range = ranges_[static_cast<std::size_t>(r)];
    std::vector<std::pair<int, std::int32_t>> order;
    for (std::int32_t i = 0; i < range.count; ++i)
      order.emplace_back(group_of(range.tile_of(i), i % kTile, range.block), i);
    std::sort(order.begin(), order.end());
    const std::byte* from = tile(static_cast<std::size_t>(range.first_tile));
    const std::vector<std::byte> before(
        from, from + stride * ((static_cast<std::size_t>(range.count) + kTile - 1) / kTile));
    for (std::int32_t i = 0; i < range.count; ++i) {
      const auto source = static_cast<std::size_t>(order[static_cast<std::size_t>(i)].second);
      copy_point(tile(range.tile_of(i)), i % kTile, before.data() + source / kTile * stride,
                 static_cast<int>(source % kTile));
    }
    fill_empty_lanes(static_cast<std::size_t>(r));
  });
}

template class ParticleSet<float>;
template class ParticleSet<double>;

}  // namespace lather
