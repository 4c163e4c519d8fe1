#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// Sets of points joined by chains of points no further apart than `reach` (m). With the spacing as reach
/// that is the foam as a union of balls of half a spacing [Foam section 6.1]: finer than the report's pieces,
/// which a few stray points in neighbouring cells still join.
struct Clusters {
  std::vector<PointState> points;
  std::vector<std::uint32_t> cluster;  ///< of each point: 0, 1, … by descending number of points
  std::vector<std::size_t> sizes;      ///< number of points of each

  /// Share of all points that lies in cluster c; 0 where there is none.
  [[nodiscard]] double share(std::size_t c) const {
    return c < sizes.size() ? static_cast<double>(sizes[c]) / static_cast<double>(points.size()) : 0;
  }
};

/// Pairs of points by their ids, the lesser first, in ascending order.
using Bonds = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Of all points, or of those that `taken` says.
[[nodiscard]] Clusters find_clusters(const Simulation& simulation, double reach,
                                     const std::function<bool(const PointState&)>& taken = {});

/// All pairs no further apart than `reach` (m), of those that `taken` says.
[[nodiscard]] Bonds find_bonds(const Simulation& simulation, double reach,
                               const std::function<bool(const PointState&)>& taken);

/// Sets of the points of `bonds` joined by chains of those bonds that are no longer than `reach` (m): pieces
/// of what was whole once, also where they touch again.
[[nodiscard]] Clusters find_pieces(const Simulation& simulation, double reach, const Bonds& bonds);

}  // namespace lather::testing_support
