#include "sim/mpm/resample/signed_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/math/parallel.h"

namespace lather::mpm::resample {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Calls visit(offset) for the 3^dim offsets of blocks.
template <class Visit>
void for_offsets(int dimension, const Visit& visit) {
  const int z = dimension == 3 ? 1 : 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -z; k <= z; ++k) visit(std::array<int, 3>{i, j, k});
}

/// Squared distances from points to the nodes of one block, in an array with a margin along z, so that a
/// point's row of four nodes can be written whole.
class NearestPoint {
 public:
  explicit NearestPoint(const Lattice& lattice)
      : lattice_(lattice),
        row_(lattice.dimension == 3 ? lattice.depth + 2 * kMargin : 1),
        squared_(static_cast<std::size_t>(lattice.width * lattice.width * row_), kFar) {}

  /// Nodes one before the point's cell to two after it: no other node lies within r of the point, nor is one
  /// the end of an edge that starts within r and ends less than 2 r away.
  void add(const Local& x) {
    const int ci = static_cast<int>(std::floor(x[0]));
    const int cj = static_cast<int>(std::floor(x[1]));
    const int ck = static_cast<int>(std::floor(x[2]));
    float z[4];
    for (int k = 0; k < 4; ++k) {
      const float d = static_cast<float>(ck - 1 + k) - x[2];
      z[k] = d * d;
    }
    for (int i = std::max(ci - 1, 0); i <= std::min(ci + 2, lattice_.width - 1); ++i) {
      const float dx = static_cast<float>(i) - x[0];
      for (int j = std::max(cj - 1, 0); j <= std::min(cj + 2, lattice_.width - 1); ++j) {
        const float dy = static_cast<float>(j) - x[1];
        const float plane = dx * dx + dy * dy;
        float* row = squared_.data() + (i * lattice_.width + j) * row_;
        if (row_ == 1) {
          *row = std::min(*row, plane);
          continue;
        }
        row += ck - 1 + kMargin;
        for (int k = 0; k < 4; ++k) {
          const float s = plane + z[k];
          row[k] = s < row[k] ? s : row[k];
        }
      }
    }
  }

  [[nodiscard]] float squared(int i, int j, int k) const {
    return squared_[static_cast<std::size_t>((i * lattice_.width + j) * row_ +
                                             (row_ == 1 ? 0 : k + kMargin))];
  }

 private:
  static constexpr int kMargin = 4;
  const Lattice& lattice_;
  int row_;
  std::vector<float> squared_;
};

}  // namespace

SignedDistance::SignedDistance(const PointBins& bins, int threads)
    : bins_(bins),
      lattice_(bins.lattice()),
      distance_(bins.all_blocks().size() * static_cast<std::size_t>(bins.lattice().cells())) {
  const std::size_t count = bins.all_blocks().size();
  const auto blocks = static_cast<std::int64_t>(count);
  parallel_for(threads, blocks, 4, [&](std::int64_t b) { categorize(static_cast<std::size_t>(b)); });
  std::vector<Crossings> crossings(count);
  parallel_for(threads, blocks, 8, [&](std::int64_t b) {
    find_crossings(static_cast<std::size_t>(b), crossings[static_cast<std::size_t>(b)]);
  });
  parallel_for(threads, blocks, 4, [&](std::int64_t b) { measure(static_cast<std::size_t>(b), crossings); });
}

/// Step 1: the distance to the nearest point, minus r.
void SignedDistance::categorize(std::size_t block) {
  NearestPoint nearest(lattice_);
  const int w = lattice_.width;
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    const std::int32_t found =
        bins_.all_blocks()[block].points[static_cast<std::size_t>(lattice_.neighbour(o))];
    if (found < 0) return;
    const auto from = static_cast<std::size_t>(found);
    int first[3];
    int last[3];
    for (int a = 0; a < 3; ++a) {
      const int n = lattice_.extent(a);
      first[a] = o[static_cast<std::size_t>(a)] < 0 ? n - 2 : 0;
      last[a] = o[static_cast<std::size_t>(a)] > 0 ? 0 : n - 1;
    }
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j) {
        const std::uint32_t end = bins_.last(from, lattice_.index(i, j, last[2]));
        for (std::uint32_t p = bins_.first(from, lattice_.index(i, j, first[2])); p < end; ++p)
          nearest.add({bins_.local(p, 0) + static_cast<float>(o[0] * w),
                       bins_.local(p, 1) + static_cast<float>(o[1] * w),
                       bins_.local(p, 2) + static_cast<float>(o[2] * w)});
      }
  });
  float* d = nodes(block);
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j)
      for (int k = 0; k < lattice_.depth; ++k) *d++ = std::sqrt(nearest.squared(i, j, k)) - 1;
}

/// Step 2: the surface's points on the lattice's edges, by linear interpolation.
void SignedDistance::find_crossings(std::size_t block, Crossings& crossings) const {
  std::vector<float> d;
  copy_nodes(block, d);
  const int w = lattice_.width;
  const int zs = lattice_.dimension == 3 ? w + 1 : 1;
  const int stride[3] = {(w + 1) * zs, zs, 1};
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j)
      for (int k = 0; k < lattice_.depth; ++k) {
        const int at = i * stride[0] + j * stride[1] + k;
        const float here = d[static_cast<std::size_t>(at)];
        for (int a = 0; a < lattice_.dimension; ++a) {
          const float there = d[static_cast<std::size_t>(at + stride[a])];
          if ((here < 0) == (there < 0)) continue;
          Local x = {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
          x[static_cast<std::size_t>(a)] += here / (here - there);
          crossings.push_back(x);
        }
      }
}

/// Step 3: the distance to the nearest of those points, with the sign of step 1.
void SignedDistance::measure(std::size_t block, const std::vector<Crossings>& crossings) {
  const int w = lattice_.width;
  const int depth = lattice_.depth;
  std::vector<float> squared(static_cast<std::size_t>(lattice_.cells()), kBand * kBand);
  const auto reach = [](float x, int n, int& first, int& last) {
    first = std::max(static_cast<int>(std::ceil(x - kBand)), 0);
    last = std::min(static_cast<int>(std::floor(x + kBand)), n - 1);
  };
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    const std::int32_t from = bins_.beyond(block, o);
    if (from < 0) return;
    for (const Local& c : crossings[static_cast<std::size_t>(from)]) {
      const Local x = {c[0] + static_cast<float>(o[0] * w), c[1] + static_cast<float>(o[1] * w),
                       c[2] + static_cast<float>(o[2] * w)};
      int first[3];
      int last[3];
      for (int a = 0; a < 3; ++a)
        reach(x[static_cast<std::size_t>(a)], lattice_.extent(a), first[a], last[a]);
      for (int i = first[0]; i <= last[0]; ++i) {
        const float dx = static_cast<float>(i) - x[0];
        for (int j = first[1]; j <= last[1]; ++j) {
          const float dy = static_cast<float>(j) - x[1];
          const float plane = dx * dx + dy * dy;
          if (plane >= kBand * kBand) continue;
          float* row = squared.data() + lattice_.index(i, j, 0);
          for (int k = first[2]; k <= last[2]; ++k) {
            const float dz = static_cast<float>(k) - x[2];
            const float s = plane + dz * dz;
            row[k] = s < row[k] ? s : row[k];
          }
        }
      }
    }
  });
  float* d = nodes(block);
  for (int n = 0; n < w * w * depth; ++n)
    d[n] = std::copysign(std::sqrt(squared[static_cast<std::size_t>(n)]), d[n]);
}

void SignedDistance::copy_nodes(std::size_t block, std::vector<float>& out) const {
  const int w = lattice_.width;
  const int zs = lattice_.dimension == 3 ? w + 1 : 1;
  out.assign(static_cast<std::size_t>((w + 1) * (w + 1) * zs), kBand);
  for (int oi = 0; oi <= 1; ++oi)
    for (int oj = 0; oj <= 1; ++oj)
      for (int ok = 0; ok <= (lattice_.dimension == 3 ? 1 : 0); ++ok) {
        const std::int32_t from = bins_.beyond(block, {oi, oj, ok});
        if (from < 0) continue;
        const float* d = nodes(static_cast<std::size_t>(from));
        for (int i = oi * w; i < (oi > 0 ? w + 1 : w); ++i)
          for (int j = oj * w; j < (oj > 0 ? w + 1 : w); ++j)
            for (int k = ok * w; k < (ok > 0 ? w + 1 : lattice_.depth); ++k)
              out[static_cast<std::size_t>((i * (w + 1) + j) * zs + k)] =
                  d[lattice_.index(i - oi * w, j - oj * w, k - ok * w)];
      }
}

}  // namespace lather::mpm::resample
