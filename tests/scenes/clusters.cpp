#include "tests/scenes/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

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

std::vector<PointState> points_of(const Simulation& simulation,
                                  const std::function<bool(const PointState&)>& taken) {
  std::vector<PointState> points;
  simulation.visit_points([&](const PointState& p) {
    if (!taken || taken(p)) points.push_back(p);
  });
  return points;
}

/// f(i, j) of all pairs no further apart than `reach`.
template <class F>
void for_pairs(const std::vector<PointState>& points, double reach, F f) {
  const auto bins = binned(points, reach);
  for (const auto& [cell, here] : bins) {
    for (int n = 0; n < 27; ++n) {
      const auto there = bins.find({cell[0] + n / 9 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n % 3 - 1});
      if (there == bins.end() || there->first < cell) continue;
      for (const std::uint32_t i : here)
        for (const std::uint32_t j : there->second)
          if ((points[i].position - points[j].position).squaredNorm() <= reach * reach) f(i, j);
    }
  }
}

}  // namespace

Clusters find_clusters(const Simulation& simulation, double reach,
                       const std::function<bool(const PointState&)>& taken) {
  Clusters c;
  c.points = points_of(simulation, taken);
  DisjointSets joined(c.points.size());
  for_pairs(c.points, reach, [&](std::uint32_t i, std::uint32_t j) { joined.join(i, j); });
  number_clusters(joined, c);
  return c;
}

Bonds find_bonds(const Simulation& simulation, double reach,
                 const std::function<bool(const PointState&)>& taken) {
  const std::vector<PointState> points = points_of(simulation, taken);
  Bonds bonds;
  for_pairs(points, reach, [&](std::uint32_t i, std::uint32_t j) {
    if (i != j) bonds.push_back(std::minmax({points[i].id, points[j].id}));
  });
  std::sort(bonds.begin(), bonds.end());
  bonds.erase(std::unique(bonds.begin(), bonds.end()), bonds.end());
  return bonds;
}

Clusters find_pieces(const Simulation& simulation, double reach, const Bonds& bonds) {
  std::set<std::uint32_t> bound;
  for (const auto& [a, b] : bonds) bound.insert({a, b});
  Clusters c;
  c.points = points_of(simulation, [&](const PointState& p) { return bound.count(p.id) != 0; });
  std::map<std::uint32_t, std::uint32_t> place;
  for (std::uint32_t i = 0; i < c.points.size(); ++i) place[c.points[i].id] = i;
  DisjointSets joined(c.points.size());
  for (const auto& [a, b] : bonds) {
    const auto i = place.find(a);
    const auto j = place.find(b);
    if (i == place.end() || j == place.end()) continue;  // one has left the domain
    if ((c.points[i->second].position - c.points[j->second].position).squaredNorm() <= reach * reach)
      joined.join(i->second, j->second);
  }
  number_clusters(joined, c);
  return c;
}

}  // namespace lather::testing_support
