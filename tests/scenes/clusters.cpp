#include "tests/scenes/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim/math/disjoint_sets.h"

namespace lather::testing_support {
namespace {

using Cell = std::array<int, 3>;

/// The points by cells of width `reach`.
std::map<Cell, std::vector<std::uint32_t>> binned(const std::vector<PointState>& points, double reach) {
  std::map<Cell, std::vector<std::uint32_t>> bins;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 x = points[i].position / reach;
    bins[{static_cast<int>(std::floor(x.x())), static_cast<int>(std::floor(x.y())),
          static_cast<int>(std::floor(x.z()))}]
        .push_back(i);
  }
  return bins;
}

/// Clusters from roots: numbered by size, the one with the first point first where sizes are equal.
void number_clusters(DisjointSets& joined, Clusters& c) {
  std::vector<std::size_t> size(c.points.size(), 0);
  for (std::uint32_t i = 0; i < c.points.size(); ++i) ++size[joined.root(i)];
  std::vector<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < size.size(); ++i)
    if (size[i] > 0) roots.push_back(i);
  std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return size[a] > size[b]; });
  std::vector<std::uint32_t> number(c.points.size());
  for (std::uint32_t n = 0; n < roots.size(); ++n) {
    number[roots[n]] = n;
    c.sizes.push_back(size[roots[n]]);
  }
  for (std::uint32_t i = 0; i < c.points.size(); ++i) c.cluster.push_back(number[joined.root(i)]);
}

}  // namespace

Clusters find_clusters(const Simulation& simulation, double reach,
                       const std::function<bool(const PointState&)>& taken) {
  Clusters c;
  simulation.visit_points([&](const PointState& p) {
    if (!taken || taken(p)) c.points.push_back(p);
  });
  const auto bins = binned(c.points, reach);
  DisjointSets joined(c.points.size());
  for (const auto& [cell, here] : bins) {
    for (int n = 0; n < 27; ++n) {
      const auto there = bins.find({cell[0] + n / 9 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n % 3 - 1});
      if (there == bins.end() || there->first < cell) continue;
      for (const std::uint32_t i : here)
        for (const std::uint32_t j : there->second)
          if ((c.points[i].position - c.points[j].position).squaredNorm() <= reach * reach) joined.join(i, j);
    }
  }
  number_clusters(joined, c);
  return c;
}

}  // namespace lather::testing_support
