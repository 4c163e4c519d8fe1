#include "sim/mpm/resample/dart_throwing.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>

#include "sim/math/counter_rng.h"
#include "sim/math/parallel.h"
#include "sim/mpm/resample/cover_masks.h"
#include "sim/mpm/resample/local_points.h"

namespace lather::mpm::resample {
namespace {

struct Dart {
  float width;  ///< of the tree's cell that it was thrown into
  Local at;
};

float squared_distance(const Local& a, const Local& b) {
  const float x = a[0] - b[0];
  const float y = a[1] - b[1];
  const float z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// The darts of one block. Scratch memory of one thread.
class BlockDarts {
 public:
  BlockDarts(const PointBins& bins, const SignedDistance& distance, NearestKernel nearest, const DartKey& key)
      : bins_(bins),
        lattice_(bins.lattice()),
        distance_(distance),
        nearest_(nearest),
        key_(key),
        masks_(CoverMasks::of(lattice_.dimension)),
        radius_(cover_radius(lattice_.dimension)),
        points_(bins.lattice()) {}

  /// Appends the darts that land in the interior of block b and that no point there covers.
  void throw_into(std::size_t b, std::vector<Dart>& found) {
    const BlockCoord& block = bins_.blocks()[b].block;
    distance_.copy_nodes(static_cast<std::size_t>(
                             bins_.blocks()[b].grid[static_cast<std::size_t>(lattice_.neighbour({0, 0, 0}))]),
                         nodes_);
    if (*std::min_element(nodes_.begin(), nodes_.end()) >= kInterior) return;
    points_.copy(bins_, b);
    masks_.clear(lattice_, covered_);
    for (std::size_t p = 0; p < points_.size(); ++p) masks_.cover(lattice_, points_.at(p), covered_);
    const std::uint64_t block_seed = random_bits(key_.seed, key_.step, block_key(block));
    for (int i = 0; i < lattice_.width; ++i)
      for (int j = 0; j < lattice_.width; ++j)
        for (int k = 0; k < lattice_.depth; ++k) {
          const std::uint64_t covered = covered_[CoverMasks::index(lattice_, i, j, k)];
          if (covered == ~std::uint64_t{0} || !read_corners(i, j, k)) continue;
          const auto cell = static_cast<std::uint64_t>(lattice_.index(i, j, k));
          throw_into_cell({i, j, k}, covered, random_bits(block_seed, cell), found);
        }
  }

 private:
  /// The distances at a cell's corners; false if none is under kInterior.
  bool read_corners(int i, int j, int k) {
    const int w = lattice_.width + 1;
    const int zs = lattice_.dimension == 3 ? w : 1;
    bool some = false;
    for (int c = 0; c < power(2, lattice_.dimension); ++c) {
      const int at = ((i + (c & 1)) * w + j + (c >> 1 & 1)) * zs + k + (c >> 2);
      corners_[c] = nodes_[static_cast<std::size_t>(at)];
      some = some || corners_[c] < kInterior;
    }
    return some;
  }

  /// The distance at `f`, fractions of the cell, by linear interpolation along each axis.
  [[nodiscard]] float interpolate(const Local& f) const {
    const auto along_x = [&](int c) { return corners_[c] + f[0] * (corners_[c + 1] - corners_[c]); };
    const auto in_plane = [&](int c) { return along_x(c) + f[1] * (along_x(c + 2) - along_x(c)); };
    if (lattice_.dimension == 2) return in_plane(0);
    return in_plane(0) + f[2] * (in_plane(4) - in_plane(0));
  }

  /// The darts into parts that are not covered, 16 at a time.
  void throw_into_cell(const std::array<int, 3>& cell, std::uint64_t covered, std::uint64_t seed,
                       std::vector<Dart>& found) {
    std::uint32_t rows[LocalPoints::kRows][2];
    const PointRows around = points_.around(cell[0], cell[1], cell[2], rows);
    int count = 0;
    const auto throw_into = [&](std::size_t t) {
      aim(t, random_bits(seed, t), cell, count);
      if (++count == kTile) land(count, around, cell, found), count = 0;
    };
    const auto& tree = masks_.tree();
    const std::size_t finest = tree.size() - 64;
    for (std::size_t t = 0; t < finest; ++t)
      if ((tree[t].mask & ~covered) != 0) throw_into(t);
    for (std::uint64_t open = ~covered; open != 0; open &= open - 1)
      throw_into(finest + static_cast<std::size_t>(std::countr_zero(open)));
    land(count, around, cell, found);
  }

  /// Throws dart k into part t of the tree.
  void aim(std::size_t t, std::uint64_t bits, const std::array<int, 3>& cell, int k) {
    const TreeCell& part = masks_.tree()[t];
    width_[k] = part.width;
    for (std::size_t a = 0; a < static_cast<std::size_t>(lattice_.dimension); ++a) {
      constexpr std::uint32_t kDraw = (1U << 21U) - 1;  // three numbers out of 64 bits
      const auto draw = static_cast<std::int32_t>(bits >> (21 * a) & kDraw);
      const float f = (static_cast<float>(draw) + 0.5F) / static_cast<float>(kDraw + 1);
      place_[a][k] = static_cast<float>(cell[a]) + (part.low[a] + part.width * f);
    }
  }

  /// Of the first `count` darts, those that no point covers and that are in the interior.
  void land(int count, const PointRows& around, const std::array<int, 3>& cell, std::vector<Dart>& found) {
    if (count == 0) return;
    for (auto& axis : place_) std::fill(axis + count, axis + kTile, axis[0]);
    float squared[kTile];
    std::fill_n(squared, kTile, std::numeric_limits<float>::infinity());
    nearest_(place_[0], kTile, around, radius_ * radius_, squared);
    for (int k = 0; k < count; ++k) {
      if (squared[k] <= radius_ * radius_) continue;
      const Local x = {place_[0][k], place_[1][k], place_[2][k]};
      Local f{};
      for (std::size_t a = 0; a < 3; ++a) f[a] = x[a] - static_cast<float>(cell[a]);
      if (interpolate(f) < kInterior) found.push_back({width_[k], x});
    }
  }

  const PointBins& bins_;
  const Lattice& lattice_;
  const SignedDistance& distance_;
  NearestKernel nearest_;
  DartKey key_;
  const CoverMasks& masks_;
  float radius_;
  std::vector<float> nodes_;
  LocalPoints points_;
  std::vector<std::uint64_t> covered_;
  float corners_[8] = {};
  float place_[3][kTile] = {};  // of the darts at hand
  float width_[kTile] = {};     // of the parts that they were thrown into
};

/// The samples taken so far, by lattice cell, to keep them apart.
class Taken {
 public:
  explicit Taken(const PointBins& bins)
      : bins_(bins), radius_(cover_radius(bins.lattice().dimension)), cells_(bins.blocks().size()) {}

  /// Takes the place unless one taken before covers it.
  bool take(std::size_t b, const Local& x) {
    const Lattice& lattice = bins_.lattice();
    int cell[3] = {0, 0, 0};
    for (int a = 0; a < lattice.dimension; ++a)  // rounding may reach the end
      cell[a] = std::min(static_cast<int>(x[static_cast<std::size_t>(a)]), lattice.extent(a) - 1);
    const int z = lattice.dimension == 3 ? 1 : 0;
    for (int i = cell[0] - 1; i <= cell[0] + 1; ++i)
      for (int j = cell[1] - 1; j <= cell[1] + 1; ++j)
        for (int k = cell[2] - z; k <= cell[2] + z; ++k)
          if (covers(b, {i, j, k}, x)) return false;
    cells_[b][lattice.index(cell[0], cell[1], cell[2])].push_back(x);
    return true;
  }

 private:
  [[nodiscard]] bool covers(std::size_t b, std::array<int, 3> cell, const Local& x) const {
    const Lattice& lattice = bins_.lattice();
    std::array<int, 3> offset{};
    Local from = x;
    for (int a = 0; a < lattice.dimension; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const int n = lattice.extent(a);
      offset[axis] = cell[axis] < 0 ? -1 : cell[axis] >= n ? 1 : 0;
      cell[axis] -= offset[axis] * n;
      from[axis] -= static_cast<float>(offset[axis] * n);
    }
    const std::int32_t block = bins_.neighbour(b, offset);
    if (block < 0) return false;
    const auto& cells = cells_[static_cast<std::size_t>(block)];
    const auto found = cells.find(lattice.index(cell[0], cell[1], cell[2]));
    return found != cells.end() &&
           std::any_of(found->second.begin(), found->second.end(),
                       [&](const Local& p) { return squared_distance(p, from) <= radius_ * radius_; });
  }

  const PointBins& bins_;
  float radius_;
  std::vector<std::unordered_map<int, std::vector<Local>>> cells_;  // per block: looked up, never walked
};

}  // namespace

std::vector<Sample> throw_darts(const PointBins& bins, const SignedDistance& distance, NearestKernel nearest,
                                const DartKey& key, const std::function<bool(const Vec3&)>& allowed,
                                int threads) {
  const std::size_t blocks = bins.blocks().size();
  std::vector<std::vector<Dart>> found(blocks);
  std::vector<BlockDarts> scratch(static_cast<std::size_t>(threads),
                                  BlockDarts(bins, distance, nearest, key));
  parallel_for(threads, static_cast<std::int64_t>(blocks), 4, [&](std::int64_t b) {
    const auto block = static_cast<std::size_t>(b);
    scratch[static_cast<std::size_t>(thread_index())].throw_into(block, found[block]);
  });
  std::vector<Sample> samples;
  Taken taken(bins);
  for (const TreeCell& cell : CoverMasks::of(bins.lattice().dimension).tree()) {
    if (cell.low != Local{0, 0, 0}) continue;  // one of each level
    for (std::size_t b = 0; b < blocks; ++b)
      for (const Dart& dart : found[b]) {
        if (dart.width != cell.width) continue;
        const Vec3 x = bins.lattice().world(bins.blocks()[b].block, dart.at);
        if (allowed(x) && taken.take(b, dart.at)) samples.push_back({b, dart.at});
      }
  }
  return samples;
}

}  // namespace lather::mpm::resample
