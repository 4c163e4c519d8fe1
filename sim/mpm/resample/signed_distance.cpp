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

}  // namespace

SignedDistance::SignedDistance(const PointBins& bins, NearestKernel kernel, int threads)
    : bins_(bins),
      lattice_(bins.lattice()),
      nearest_(kernel),
      places_(3 * static_cast<std::size_t>(bins.lattice().cells())),
      distance_(bins.all_blocks().size() * static_cast<std::size_t>(bins.lattice().cells())),
      side_(bins.all_blocks().size(), Side::kOutside) {
  const auto nodes_of_block = static_cast<std::size_t>(lattice_.cells());
  for (std::size_t n = 0; n < nodes_of_block; ++n) {
    const auto at = static_cast<int>(n);
    const int row = at / lattice_.depth;
    const int plane = row / lattice_.width;
    places_[n] = static_cast<float>(plane);
    places_[nodes_of_block + n] = static_cast<float>(row % lattice_.width);
    places_[2 * nodes_of_block + n] = static_cast<float>(at % lattice_.depth);
  }
  const std::size_t count = bins.all_blocks().size();
  const auto blocks = static_cast<std::int64_t>(count);
  parallel_for(threads, blocks, 4, [&](std::int64_t b) { categorize(static_cast<std::size_t>(b)); });
  std::vector<Crossings> crossings(count);
  parallel_for(threads, blocks, 8, [&](std::int64_t b) {
    find_crossings(static_cast<std::size_t>(b), crossings[static_cast<std::size_t>(b)]);
  });
  parallel_for(threads, blocks, 4, [&](std::int64_t b) { measure(static_cast<std::size_t>(b), crossings); });
}

/// Step 1: the distance to the nearest point, minus r. A node within r of a point is a corner of the point's
/// cell, so only inside nodes get their distance here; the few outside ones that matter get it in step 2.
void SignedDistance::categorize(std::size_t block) {
  const int w = lattice_.width;
  const int zn = lattice_.dimension == 3 ? 2 : 1;  // a cell's corners along z
  float* d = nodes(block);
  std::fill_n(d, lattice_.cells(), kFar);
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    if (o[0] > 0 || o[1] > 0 || o[2] > 0) return;
    int first[3];
    int last[3];
    for (int a = 0; a < 3; ++a) {
      first[a] = o[static_cast<std::size_t>(a)] < 0 ? -1 : 0;
      last[a] = o[static_cast<std::size_t>(a)] < 0 ? -1 : lattice_.extent(a) - 1;
    }
    bins_.for_points_around(
        block, {first[0], first[1], first[2]}, {last[0], last[1], last[2]},
        [&](std::uint32_t, const Local& x) {
          int c[3];
          float squared[3][2];
          for (std::size_t a = 0; a < 3; ++a) {
            c[a] = static_cast<int>(std::floor(x[a]));
            const float f = x[a] - static_cast<float>(c[a]);
            squared[a][0] = f * f;
            squared[a][1] = (1 - f) * (1 - f);
          }
          for (int i = std::max(c[0], 0); i <= std::min(c[0] + 1, w - 1); ++i)
            for (int j = std::max(c[1], 0); j <= std::min(c[1] + 1, w - 1); ++j)
              for (int k = std::max(c[2], 0); k <= std::min(c[2] + zn - 1, lattice_.depth - 1); ++k) {
                const float s = squared[0][i - c[0]] + squared[1][j - c[1]] + squared[2][k - c[2]];
                float& at = d[lattice_.index(i, j, k)];
                at = s < at ? s : at;
              }
        });
  });
  int inside = 0;
  for (int n = 0; n < lattice_.cells(); ++n) {
    inside += d[n] < 1 ? 1 : 0;
    d[n] = d[n] < 1 ? std::sqrt(d[n]) - 1 : kFar;
  }
  if (inside > 0) side_[block] = inside == lattice_.cells() ? Side::kInside : Side::kMixed;
}

/// Distance of a node from the nearest point, minus r; the point is less than 2 r away.
float SignedDistance::nearest(std::size_t block, const std::array<int, 3>& node) const {
  float squared = kFar;
  bins_.for_points_around(block, {node[0] - 2, node[1] - 2, node[2] - 2},
                          {node[0] + 1, node[1] + 1, node[2] + 1}, [&](std::uint32_t, const Local& x) {
                            float s = 0;
                            for (std::size_t a = 0; a < 3; ++a) {
                              const float along = x[a] - static_cast<float>(node[a]);
                              s += along * along;
                            }
                            squared = std::min(squared, s);
                          });
  return std::sqrt(squared) - 1;
}

/// True if no edge that starts in the block crosses the surface, for all nodes there are on one side.
bool SignedDistance::uniform_around(std::size_t block) const {
  bool same = side_[block] != Side::kMixed;
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    if (o[0] < 0 || o[1] < 0 || o[2] < 0) return;
    const std::int32_t there = bins_.beyond(block, o);
    same = same && side_[block] == (there < 0 ? Side::kOutside : side_[static_cast<std::size_t>(there)]);
  });
  return same;
}

/// Step 2: the surface's points on the lattice's edges, by linear interpolation.
void SignedDistance::find_crossings(std::size_t block, Crossings& crossings) const {
  if (uniform_around(block)) return;
  std::vector<float> d;
  copy_nodes(block, d);
  const int w = lattice_.width;
  const int zs = lattice_.dimension == 3 ? w + 1 : 1;
  const int stride[3] = {(w + 1) * zs, zs, 1};
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j)
      for (int k = 0; k < lattice_.depth; ++k)
        for (std::size_t a = 0; a < static_cast<std::size_t>(lattice_.dimension); ++a) {
          const int at = i * stride[0] + j * stride[1] + k;
          float here = d[static_cast<std::size_t>(at)];
          float there = d[static_cast<std::size_t>(at + stride[a])];
          if ((here < 0) == (there < 0)) continue;
          std::array<int, 3> node = {i, j, k};
          if (here >= 0) here = nearest(block, node);
          ++node[a];
          if (there >= 0) there = nearest(block, node);
          Local x = {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
          x[a] += here / (here - there);
          crossings.push_back(x);
        }
}

/// Step 3: the distance to the nearest of those points, with the sign of step 1.
void SignedDistance::measure(std::size_t block, const std::vector<Crossings>& crossings) {
  bool any = false;
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    const std::int32_t from = bins_.beyond(block, o);
    any = any || (from >= 0 && !crossings[static_cast<std::size_t>(from)].empty());
  });
  if (!any) {
    std::fill_n(nodes(block), lattice_.cells(), side_[block] == Side::kInside ? -kBand : kBand);
    return;
  }
  std::vector<Local> near;  // those that a node of the block may be within the band of
  for_offsets(lattice_.dimension, [&](const std::array<int, 3>& o) {
    const std::int32_t from = bins_.beyond(block, o);
    if (from < 0) return;
    for (const Local& c : crossings[static_cast<std::size_t>(from)]) {
      Local x{};
      bool reaches = true;
      for (std::size_t a = 0; a < 3; ++a) {
        const auto n = static_cast<float>(lattice_.extent(static_cast<int>(a)));
        x[a] = c[a] + static_cast<float>(o[a]) * n;
        reaches = reaches && x[a] > -kBand && x[a] < n - 1 + kBand;
      }
      if (reaches) near.push_back(x);
    }
  });
  std::vector<float> squared(static_cast<std::size_t>(lattice_.cells()), kBand * kBand);
  const std::uint32_t all[1][2] = {{0, static_cast<std::uint32_t>(near.size())}};
  if (!near.empty())
    nearest_(places_.data(), lattice_.cells(), {near.front().data(), all, 1}, 0, squared.data());
  float* d = nodes(block);
  for (int n = 0; n < lattice_.cells(); ++n)
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
