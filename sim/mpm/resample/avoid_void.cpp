#include "sim/mpm/resample/avoid_void.h"

#include "sim/mpm/resample/false_tears.h"
#include "sim/mpm/resample/merge.h"

namespace lather::mpm::resample {
namespace {

/// Adds the new points to their sets. Returns the change of momentum: theirs, less what the gifts took along.
template <class Real>
Vec3 insert_points(const std::vector<NewPoint>& points, const std::vector<double>& values,
                   const PointBins& bins, std::vector<ParticleSet<Real>>& sets, const Resampler& resampler,
                   std::uint32_t& next_id) {
  Vec3 change = Vec3::Zero();
  const std::size_t stride = values_stride(sets);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NewPoint& point = points[i];
    ParticleSet<Real>& set = sets[point.set];
    const Vec3 x = bins.lattice().world(bins.blocks()[point.sample.block].block, point.sample.at);
    const PointSlot slot = set.add(x, Vec3::Zero(), Mat3::Zero(), next_id++);
    const PointValues list(set.layout());
    list.write(set, slot, values.data() + i * stride);
    set.template values<Real>(slot.tile, Field::kShare)[slot.lane] = static_cast<Real>(point.share);
    Vec3 given = Vec3::Zero();
    for (const Gift& gift : point.gifts) {
      const PointSlot donor = bins.point(gift.donor).slot;
      given += gift.share * set.velocity(donor.tile, donor.lane);
    }
    change += resampler.mass[point.set] * (point.share * set.velocity(slot.tile, slot.lane) - given);
  }
  return change;
}

}  // namespace

template <class Real>
Outcome avoid_void(std::vector<ParticleSet<Real>>& sets, const BlockGrid<Real>& grid,
                   const Resampler& resampler, const DartKey& key, std::uint32_t& next_id) {
  const int threads = resampler.threads;
  const PointBins bins(sets, grid, resampler.bounds, resampler.lattice, threads);
  const SignedDistance distance(bins, resampler.nearest, threads);
  const std::vector<Sample> samples =
      throw_darts(bins, distance, resampler.nearest, key, resampler.allowed, threads);
  const std::vector<NewPoint> points = compute_new_conserved_values(samples, bins, sets, threads);
  std::vector<double> values =
      compute_new_field_values(points, bins, sets, resampler.weights, resampler.velocity, threads);
  mend_false_tears(points, bins, sets, resampler.tears, values);
  const Vec3 by_new = insert_points(points, values, bins, sets, resampler, next_id);
  const std::vector<Pair> pairs = find_pairs(bins, threads);
  const Vec3 by_merged = merge_points(pairs, bins, sets, resampler.mass);
  return {points.size(), pairs.size(), by_new + by_merged};
}

template Outcome avoid_void(std::vector<ParticleSet<float>>&, const BlockGrid<float>&, const Resampler&,
                            const DartKey&, std::uint32_t&);
template Outcome avoid_void(std::vector<ParticleSet<double>>&, const BlockGrid<double>&, const Resampler&,
                            const DartKey&, std::uint32_t&);

}  // namespace lather::mpm::resample
