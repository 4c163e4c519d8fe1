#include "sim/mlsrk/cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/math/parallel.h"

namespace lather::mlsrk {
namespace {

constexpr int kBlockCells = 4;

/// One set's points in a block.
struct Part {
  std::uint64_t key;
  std::uint32_t set;
  std::uint32_t range;
};

template <class Real>
std::vector<Part> parts_by_block(const std::vector<ParticleSet<Real>>& sets) {
  std::vector<Part> parts;
  for (std::uint32_t s = 0; s < sets.size(); ++s)
    for (std::uint32_t r = 0; r < sets[s].ranges().size(); ++r)
      parts.push_back({block_key(sets[s].ranges()[r].block), s, r});
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.key < b.key; });
  return parts;
}

std::int32_t floor_mod(std::int32_t a, std::int32_t n) {
  return ((a % n) + n) % n;
}

}  // namespace

template <class Real>
Cloud<Real>::Cloud(const Scene& scene)
    : dimension_(scene.dimension),
      origin_(scene.domain.box.min),
      spacing_(scene.spacing),
      scale_(0.5 * scene.numerics.mlsrk.support_radius * scene.spacing),
      reach_(static_cast<int>(
          std::ceil((scene.numerics.mlsrk.support_radius + 2 * kDriftMargin) / kBlockCells))),
      per_volume_(static_cast<Real>(std::pow(scale_, -scene.dimension))) {}

template <class Real>
void Cloud<Real>::build(const std::vector<ParticleSet<Real>>& sets, const CellBounds& bounds) {
  blocks_.clear();
  tiles_.clear();
  sources_.clear();
  slot_of_.resize(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) slot_of_[s].assign(sets[s].tiles() * kTile, 0);
  std::uint64_t last = ~std::uint64_t{0};
  for (const Part& part : parts_by_block(sets)) {
    const BlockRange& range = sets[part.set].ranges()[part.range];
    if (part.key != last) {
      sources_.resize(tiles_.size() * kTile, {0, 0});
      blocks_.push_back({range.block, static_cast<std::int32_t>(tiles_.size()), 0, 0, 0});
    }
    last = part.key;
    for (std::int32_t i = 0; i < range.count; ++i) {
      if (blocks_.back().tiles == 0 || tiles_.back().count == kTile) {
        tiles_.push_back({static_cast<std::int32_t>(blocks_.size()) - 1, 0});
        ++blocks_.back().tiles;
      }
      ++tiles_.back().count;
      const std::size_t index = range.tile_of(i) * kTile + static_cast<std::size_t>(i % kTile);
      slot_of_[part.set][index] = static_cast<std::uint32_t>(sources_.size());
      sources_.push_back({part.set, static_cast<std::uint32_t>(index)});
    }
  }
  sources_.resize(slots(), {0, 0});
  extents_.resize(tiles_.size());
  place_.assign(4 * slots(), Real(0));
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (i / kTile % 4 < static_cast<std::size_t>(dimension_)) place_[i] = static_cast<Real>(kNowhere);
  find_neighbours(bounds);
}

template <class Real>
void Cloud<Real>::find_neighbours(const CellBounds& bounds) {
  neighbours_.clear();
  most_near_ = 0;
  const auto width = static_cast<Real>(kBlockCells * spacing_ / scale_);
  const int across = dimension_ == 3 ? reach_ : 0;
  for (Block& block : blocks_) {
    block.first_neighbour = static_cast<std::int32_t>(neighbours_.size());
    std::size_t near = 0;
    for (int dx = -reach_; dx <= reach_; ++dx)
      for (int dy = -reach_; dy <= reach_; ++dy)
        for (int dz = -across; dz <= across; ++dz) {
          const std::array<int, 3> offset = {dx, dy, dz};
          BlockCoord at = block.at;
          for (std::size_t a = 0; a < 3; ++a) {
            at[a] += offset[a];
            if (bounds.periodic[a]) at[a] = floor_mod(at[a], bounds.cells[a] / kBlockCells);
          }
          const std::uint64_t key = block_key(at);
          const auto found =
              std::lower_bound(blocks_.begin(), blocks_.end(), key,
                               [](const Block& b, std::uint64_t k) { return block_key(b.at) < k; });
          if (found == blocks_.end() || found->at != at) continue;
          near += static_cast<std::size_t>(found->tiles) * kTile;
          neighbours_.push_back({found->first_tile,
                                 found->tiles,
                                 {static_cast<Real>(dx) * width, static_cast<Real>(dy) * width,
                                  static_cast<Real>(dz) * width}});
        }
    block.neighbours = static_cast<std::int32_t>(neighbours_.size()) - block.first_neighbour;
    most_near_ = std::max(most_near_, near);
  }
}

template <class Real>
void Cloud<Real>::refresh(const std::vector<ParticleSet<Real>>& sets, int threads) {
  using Word = typename FixedPoint<Real>::Word;
  constexpr Real kQuantum = Real(1) / Real(std::int64_t{1} << FixedPoint<Real>::kBits);
  const auto cell_width = static_cast<Real>(spacing_ / scale_);
  parallel_for(threads, static_cast<std::int64_t>(tiles_.size()), 64, [&](std::int64_t index) {
    const auto t = static_cast<std::size_t>(index);
    const BlockCoord& block = blocks_[static_cast<std::size_t>(tiles_[t].block)].at;
    Extent<Real>& extent = extents_[t];
    for (int a = 0; a < 3; ++a)
      extent.low[a] = std::numeric_limits<Real>::max(), extent.high[a] = std::numeric_limits<Real>::lowest();
    for (int i = 0; i < tiles_[t].count; ++i) {
      const std::size_t slot = t * kTile + static_cast<std::size_t>(i);
      const Source& source = sources_[slot];
      const ParticleSet<Real>& set = sets[source.set];
      const std::size_t tile = source.index / kTile;
      const std::size_t lane = source.index % kTile;
      for (int a = 0; a < dimension_; ++a) {
        const int cell = set.template values<std::int16_t>(tile, Field::kCell, a)[lane] -
                         kBlockCells * block[static_cast<std::size_t>(a)];
        const Real fraction =
            static_cast<Real>(set.template values<Word>(tile, Field::kFraction, a)[lane]) * kQuantum;
        const Real x = (static_cast<Real>(cell) + fraction) * cell_width;
        place_[at(static_cast<std::uint32_t>(slot), a)] = x;
        extent.low[a] = std::min(extent.low[a], x);
        extent.high[a] = std::max(extent.high[a], x);
      }
    }
  });
}

template <class Real>
Vec3 Cloud<Real>::position(std::uint32_t slot) const {
  const BlockCoord& block = blocks_[static_cast<std::size_t>(tiles_[slot / kTile].block)].at;
  Vec3 x = Vec3::Zero();
  for (int a = 0; a < dimension_; ++a)
    x[a] = origin_[a] + kBlockCells * block[static_cast<std::size_t>(a)] * spacing_ +
           static_cast<double>(place_[at(slot, a)]) * scale_;
  return x;
}

template <class Real>
Box3 Cloud<Real>::box(std::size_t tile) const {
  const BlockCoord& block = blocks_[static_cast<std::size_t>(tiles_[tile].block)].at;
  Box3 box;
  for (int a = 0; a < dimension_; ++a) {
    const double corner = origin_[a] + kBlockCells * block[static_cast<std::size_t>(a)] * spacing_;
    box.min[a] = corner + static_cast<double>(extents_[tile].low[a]) * scale_;
    box.max[a] = corner + static_cast<double>(extents_[tile].high[a]) * scale_;
  }
  return box;
}

template <class Real>
Surroundings<Real> Cloud<Real>::around(std::size_t tile, Scratch& scratch) const {
  const std::size_t reals = scratch_reals(most_near_);
  const std::size_t slots = scratch_stride(most_near_);
  if (scratch.reals.size() < reals) scratch.reals.resize(reals);
  if (scratch.slots.size() < slots) scratch.slots.resize(slots);
  const Block& own = blocks_[static_cast<std::size_t>(tiles_[tile].block)];
  return {static_cast<std::uint32_t>(tile),
          tiles_[tile].count,
          place_.data(),
          extents_.data(),
          neighbours_.data() + own.first_neighbour,
          own.neighbours,
          scratch.reals.data(),
          scratch.slots.data()};
}

template <class Real>
std::size_t Cloud<Real>::bytes() const {
  std::size_t mapping = 0;
  for (const auto& slots : slot_of_) mapping += slots.size() * sizeof(std::uint32_t);
  return mapping + place_.size() * sizeof(Real) + sources_.size() * sizeof(Source) +
         tiles_.size() * (sizeof(CloudTile) + sizeof(Extent<Real>)) + blocks_.size() * sizeof(Block) +
         neighbours_.size() * sizeof(NearBlock<Real>);
}

template class Cloud<float>;
template class Cloud<double>;

}  // namespace lather::mlsrk
