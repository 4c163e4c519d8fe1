#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/mpm/resample/signed_distance.h"

namespace lather::mpm::resample {

/// How far inside the foam a new point must be, in units of r: nearer to the surface it would pop up visibly.
/// [Foam section 6.1]
inline constexpr float kInterior = -2.2F;

/// A place for a new point.
struct Sample {
  std::size_t block = 0;  ///< index into PointBins::blocks()
  Local at{};             ///< relative to that block's corner
};

/// What random numbers are keyed by, beside the place.
struct DartKey {
  std::uint64_t seed = 0;
  std::uint64_t step = 0;
};

/// Places in the interior that are further than cover_radius() from all points and from each other [Foam
/// Algorithm 3, Ebeida et al. 2012].
///
/// One dart is thrown into each active cell of an octree, level by level. Here the tree starts with the
/// lattice's cells, for no larger one can be covered by one sphere, and ends at r/4 (r/8 in 2D): what
/// smaller gap is missed now is found at a later resampling, with other darts. A cell is not active where all
/// of it is covered, nor where no corner is under kInterior: the distance, interpolated, reaches kInterior
/// nowhere in it (the paper's test, some corner at or under -alpha r, does not end).
///
/// Darts that points already there do not cover are found block by block in parallel; of these, one by one in
/// the order of level, block and cell, those are taken that no one taken before covers. That gives what the
/// sequential algorithm gives. `allowed(x)`, x in m, refuses more places: obstacles' insides.
[[nodiscard]] std::vector<Sample> throw_darts(const PointBins& bins, const SignedDistance& distance,
                                              NearestKernel nearest, const DartKey& key,
                                              const std::function<bool(const Vec3&)>& allowed, int threads);

}  // namespace lather::mpm::resample
