#pragma once

#include "sim/mpm/resample/false_tears.h"
#include "sim/mpm/resample/field_values.h"

namespace lather::mpm::resample {

/// Everything but the points that a resampling reads.
struct Resampler {
  Lattice lattice;
  CellBounds bounds;
  std::vector<double> mass;  ///< of a whole point of each set, kg
  KernelWeights weights;
  NearestKernel nearest = nullptr;
  NewVelocity velocity = NewVelocity::kConserving;
  TearTest tears;
  std::function<bool(const Vec3&)> allowed;  ///< may a new point stand at x (m)? not inside obstacles
  int threads = 1;
};

/// What a resampling did.
struct Outcome {
  std::uint64_t inserted = 0;
  std::uint64_t merged = 0;             ///< pairs
  Vec3 momentum_change = Vec3::Zero();  ///< kg m/s
};

/// "Avoid a void" [Foam section 6, Algorithm 18]: fills gaps in the interior with new points and merges
/// points that are too close. Only the sign of all materials together says what is foam; each new point takes
/// the material of its nearest neighbour and everything else from points of that material, and only points of
/// one material are merged.
///
/// The sets must just have been sorted and `grid` rebuilt; if anything changed they must be sorted again. New
/// points get ids from `next_id` on, in a fixed order. Every set carries shares.
template <class Real>
Outcome avoid_void(std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid,
                   const Resampler& resampler, const DartKey& key, std::uint32_t& next_id);

}  // namespace lather::mpm::resample
