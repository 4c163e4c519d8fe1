#include "sim/mpm/resample/field_values.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"

namespace lather::mpm::resample {
namespace {

/// The nodes that a block's points reach, relative to its first, and their kernel weights for one point.
struct Stencil {
  int base[3] = {0, 0, 0};  ///< first node's index in the block's buffer of kBufferWidth^dim nodes
  double weight[3][4] = {{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
  int last[3] = {0, 0, 0};  ///< nodes per axis, less one

  Stencil(const Lattice& lattice, const KernelWeights& weights, const Local& x) {
    const double per_cell = static_cast<double>(lattice.width) / kBlockWidth;
    for (int a = 0; a < lattice.dimension; ++a) {
      const double y = static_cast<double>(x[static_cast<std::size_t>(a)]) / per_cell - kHomeShift;
      const double cell = std::floor(y);
      base[a] = static_cast<int>(cell) + weights(y - cell, weight[a]) + kBufferBelow;
      last[a] = 3;
    }
  }

  /// Calls visit(node, weight) for nodes within the buffer that have a weight.
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    for (int i = 0; i <= last[0]; ++i)
      for (int j = 0; j <= last[1]; ++j)
        for (int k = 0; k <= last[2]; ++k) {
          const double w = weight[0][i] * weight[1][j] * weight[2][k];
          const int at[3] = {base[0] + i, base[1] + j, base[2] + k};
          if (w > 0 && std::all_of(at, at + 3, [](int n) { return n >= 0 && n < kBufferWidth; }))
            visit((at[0] * kBufferWidth + at[1]) * kBufferWidth + at[2], w);
        }
  }
};

/// Values on the nodes around one block, of one material.
template <class Real>
class NodeMeans {
 public:
  NodeMeans(const PointBins& bins, const std::vector<ParticleSet<Real>>& sets, const KernelWeights& weights)
      : bins_(bins), sets_(sets), weights_(weights) {}

  /// Averages, at the nodes that `points` (of block b and set s) read, over all points of the set. [eq. 19]
  void average(std::size_t b, std::uint8_t s, const PointValues& values, const std::vector<Local>& points) {
    const std::size_t count = values.count() + 1;  // the last is the sum of weights
    sums_.assign(static_cast<std::size_t>(power(kBufferWidth, 3)) * count, 0.0);
    needed_.assign(static_cast<std::size_t>(power(kBufferWidth, 3)), 0);
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    low.fill(1 << 20);
    high.fill(-(1 << 20));
    const int reach = bins_.lattice().width;  // a block's width: the points of a point's nodes lie within
    for (const Local& x : points) {
      Stencil(bins_.lattice(), weights_, x).for_nodes([&](int node, double) {
        needed_[static_cast<std::size_t>(node)] = 1;
      });
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::max(-reach, std::min(low[a], static_cast<int>(x[a]) - reach));
        high[a] = std::min(2 * reach - 1, std::max(high[a], static_cast<int>(x[a]) + reach));
      }
    }
    std::vector<double> own(count);
    bins_.for_points(b, low, high, [&](std::uint32_t p, const Local& x) {
      const BinnedPoint& q = bins_.point(p);
      if (q.set != s) return;
      bool read = false;
      const double mass = sets_[s].share(q.slot.tile, q.slot.lane);
      Stencil(bins_.lattice(), weights_, x).for_nodes([&](int node, double w) {
        if (needed_[static_cast<std::size_t>(node)] == 0) return;
        if (!read) values.read(sets_[s], q.slot, own.data());
        read = true;
        own.back() = 1;
        double* sum = sums_.data() + static_cast<std::size_t>(node) * count;
        for (std::size_t v = 0; v < count; ++v) sum[v] += w * mass * own[v];
      });
    });
  }

  /// The means, interpolated at x. [eq. 20] A node without points is left out, and the others weigh more.
  void interpolate(const Local& x, const PointValues& values, double* to) const {
    const std::size_t count = values.count() + 1;
    std::fill_n(to, values.count(), 0.0);
    double used = 0;
    Stencil(bins_.lattice(), weights_, x).for_nodes([&](int node, double w) {
      const double* sum = sums_.data() + static_cast<std::size_t>(node) * count;
      if (sum[count - 1] <= 0) return;
      used += w;
      for (std::size_t v = 0; v + 1 < count; ++v) to[v] += w * sum[v] / sum[count - 1];
    });
    for (std::size_t v = 0; v < values.count(); ++v) to[v] /= used;
  }

 private:
  const PointBins& bins_;
  const std::vector<ParticleSet<Real>>& sets_;
  const KernelWeights& weights_;
  std::vector<double> sums_;
  std::vector<char> needed_;
};

/// Velocity and affine velocity as the donors' mean.
template <class Real>
void take_donors_velocity(const NewPoint& point, const PointBins& bins,
                          const std::vector<ParticleSet<Real>>& sets, const PointValues& values, double* to) {
  std::vector<double> donor(values.count());
  for (const Field f : {Field::kVelocity, Field::kAffine}) {
    if (!values.has(f)) continue;
    const std::size_t first = values.at(f);
    const std::size_t end = first + values.components(f);
    std::fill(to + first, to + end, 0.0);
    for (const Gift& gift : point.gifts) {
      values.read(sets[point.set], bins.point(gift.donor).slot, donor.data());
      for (std::size_t v = first; v < end; ++v) to[v] += gift.share / point.share * donor[v];
    }
  }
}

}  // namespace

template <class Real>
std::size_t values_stride(const std::vector<ParticleSet<Real>>& sets) {
  std::size_t stride = 0;
  for (const auto& set : sets) stride = std::max(stride, PointValues(set.layout()).count());
  return stride;
}

template <class Real>
std::vector<double> compute_new_field_values(const std::vector<NewPoint>& points, const PointBins& bins,
                                             const std::vector<ParticleSet<Real>>& sets,
                                             const KernelWeights& weights, NewVelocity velocity,
                                             int threads) {
  if (points.empty()) return {};
  std::vector<PointValues> lists;  // a material's points hold what it needs
  for (const auto& set : sets) lists.emplace_back(set.layout());
  const std::size_t stride = values_stride(sets);
  std::vector<double> all(points.size() * stride);
  // By block and material: their nodes are computed once.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto group = [&](std::size_t i) { return std::make_pair(points[i].sample.block, points[i].set); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return group(a) < group(b); });
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || group(order[i]) != group(order[i - 1])) starts.push_back(i);
  starts.push_back(order.size());
  parallel_for(threads, static_cast<std::int64_t>(starts.size()) - 1, 1, [&](std::int64_t g) {
    const std::size_t first = starts[static_cast<std::size_t>(g)];
    const std::size_t end = starts[static_cast<std::size_t>(g) + 1];
    const auto [block, set] = group(order[first]);
    const PointValues& values = lists[set];
    std::vector<Local> places;
    for (std::size_t i = first; i < end; ++i) places.push_back(points[order[i]].sample.at);
    NodeMeans<Real> means(bins, sets, weights);
    means.average(block, set, values, places);
    for (std::size_t i = first; i < end; ++i) {
      const NewPoint& point = points[order[i]];
      double* to = all.data() + order[i] * stride;
      means.interpolate(point.sample.at, values, to);
      if (velocity == NewVelocity::kConserving) take_donors_velocity(point, bins, sets, values, to);
      values.renormalize(to);
    }
  });
  return all;
}

template std::size_t values_stride(const std::vector<ParticleSet<float>>&);
template std::size_t values_stride(const std::vector<ParticleSet<double>>&);
template std::vector<double> compute_new_field_values(const std::vector<NewPoint>&, const PointBins&,
                                                      const std::vector<ParticleSet<float>>&,
                                                      const KernelWeights&, NewVelocity, int);
template std::vector<double> compute_new_field_values(const std::vector<NewPoint>&, const PointBins&,
                                                      const std::vector<ParticleSet<double>>&,
                                                      const KernelWeights&, NewVelocity, int);

}  // namespace lather::mpm::resample
