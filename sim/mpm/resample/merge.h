#pragma once

#include <vector>

#include "sim/mpm/resample/point_bins.h"
#include "sim/mpm/resample/point_values.h"

namespace lather::mpm::resample {

/// Points of one material that are closer than this, in units of r, become one. [Foam section 6.2]
inline constexpr float kMergeDistance = 0.03F;

/// Two points of one set. Neither is in another pair.
struct Pair {
  std::uint32_t kept = 0;     ///< index into the bins; the one with the lower id
  std::uint32_t removed = 0;  ///< the other
  Local apart{};              ///< from kept to removed, units of r
};

/// Pairs of points to be merged, each point and its nearest neighbour: disjoint, chosen greedily in ascending
/// order of ids [Foam Algorithm 21, without p as its own neighbour].
[[nodiscard]] std::vector<Pair> find_pairs(const PointBins& bins, int threads);

/// Replaces each pair by one point: the sum of what is conserved, mass-weighted means of all else, at the
/// centre of mass. It keeps the lower id; the other is never used again. Sort the sets afterwards. `mass[s]`
/// is that of a whole point of set s, kg. Returns the change of momentum, which is rounding, kg m/s.
template <class Real>
Vec3 merge_points(const std::vector<Pair>& pairs, const PointBins& bins, std::vector<ParticleSet<Real>>& sets,
                  const std::vector<double>& mass);

}  // namespace lather::mpm::resample
