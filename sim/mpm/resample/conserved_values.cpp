#include "sim/mpm/resample/conserved_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/math/parallel.h"

namespace lather::mpm::resample {
namespace {

constexpr double kShareQuantum = 0x1p-20;

/// Calls visit(p, squared distance) for the points in the cells within `radius` of a place.
template <class Visit>
void for_points_near(const PointBins& bins, const Sample& s, float radius, const Visit& visit) {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = static_cast<int>(std::floor(s.at[a] - radius));
    high[a] = static_cast<int>(std::floor(s.at[a] + radius));
  }
  bins.for_points(s.block, low, high, [&](std::uint32_t p, const Local& x) {
    float squared = 0;
    for (std::size_t a = 0; a < 3; ++a) squared += (x[a] - s.at[a]) * (x[a] - s.at[a]);
    visit(p, squared);
  });
}

/// Material and donors of a new point; their gifts are not yet made out.
NewPoint find_donors(const PointBins& bins, const Sample& sample) {
  NewPoint point;
  point.sample = sample;
  const auto widest = static_cast<float>(bins.lattice().width - 1);
  for (float radius = 1; point.gifts.empty() && radius <= widest; radius *= 1.25F) {
    float nearest = std::numeric_limits<float>::infinity();
    std::uint32_t nearest_id = kNoPoint;
    for_points_near(bins, sample, radius, [&](std::uint32_t p, float squared) {
      const BinnedPoint& q = bins.point(p);
      if (squared > nearest || (squared == nearest && q.id > nearest_id)) return;
      nearest = squared;
      nearest_id = q.id;
      point.set = q.set;
    });
    for_points_near(bins, sample, radius, [&](std::uint32_t p, float squared) {
      if (squared < radius * radius && bins.point(p).set == point.set) point.gifts.push_back({p, 0});
    });
  }
  return point;
}

}  // namespace

template <class Real>
std::vector<NewPoint> compute_new_conserved_values(const std::vector<Sample>& samples, const PointBins& bins,
                                                   std::vector<ParticleSet<Real>>& sets, int threads) {
  std::vector<NewPoint> points(samples.size());
  parallel_for(threads, static_cast<std::int64_t>(samples.size()), 16, [&](std::int64_t i) {
    points[static_cast<std::size_t>(i)] = find_donors(bins, samples[static_cast<std::size_t>(i)]);
  });
  for (NewPoint& point : points) {
    const auto count = static_cast<double>(point.gifts.size());
    for (Gift& gift : point.gifts) {
      const PointSlot slot = bins.point(gift.donor).slot;
      Real& share = sets[point.set].template values<Real>(slot.tile, Field::kShare)[slot.lane];
      const auto has = static_cast<double>(share);
      gift.share = std::floor(has / (count + 1) / kShareQuantum) * kShareQuantum;
      point.share += gift.share;
      share = static_cast<Real>(has - gift.share);
    }
  }
  points.erase(std::remove_if(points.begin(), points.end(), [](const NewPoint& p) { return p.share == 0; }),
               points.end());
  return points;
}

template std::vector<NewPoint> compute_new_conserved_values(const std::vector<Sample>&, const PointBins&,
                                                            std::vector<ParticleSet<float>>&, int);
template std::vector<NewPoint> compute_new_conserved_values(const std::vector<Sample>&, const PointBins&,
                                                            std::vector<ParticleSet<double>>&, int);

}  // namespace lather::mpm::resample
