#pragma once

#include <vector>

#include "sim/mpm/resample/dart_throwing.h"

namespace lather::mpm::resample {

/// What a point gives to a new one: part of its mass and volume.
struct Gift {
  std::uint32_t donor = 0;  ///< index into the bins
  double share = 0;         ///< of the mass and volume that a point is sampled with
};

/// A point to be inserted.
struct NewPoint {
  Sample sample;
  std::uint8_t set = 0;  ///< material: that of the nearest point
  double share = 0;      ///< sum of the gifts
  std::vector<Gift> gifts;
};

/// Mass and volume of new points [Foam Algorithm 19]: each of the N points of the same material within r
/// gives 1/(N+1) of what it has; where there is none, the radius grows until there is. The donors' shares in
/// `sets` shrink at once, so that the next new point's gifts are parts of what is left.
///
/// Shares are multiples of 2^-20 (gifts are rounded down to that): sums of them are exact in float up to 16,
/// and mass is conserved to the last bit. A new point to which nobody can give is left out.
template <class Real>
[[nodiscard]] std::vector<NewPoint> compute_new_conserved_values(const std::vector<Sample>& samples,
                                                                 const PointBins& bins,
                                                                 std::vector<ParticleSet<Real>>& sets,
                                                                 int threads);

}  // namespace lather::mpm::resample
