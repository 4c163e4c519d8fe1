#include "sim/mpm/resample/merge.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"

namespace lather::mpm::resample {
namespace {

/// The nearest point of the same material within kMergeDistance of point p of block b, as a pair; false if
/// there is none. Of equally near ones that with the lowest id.
bool find_nearest(const PointBins& bins, std::size_t b, std::uint32_t p, Pair& pair) {
  const Local here = bins.local(p);
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = static_cast<int>(std::floor(here[a] - kMergeDistance));
    high[a] = static_cast<int>(std::floor(here[a] + kMergeDistance));
  }
  float nearest = kMergeDistance * kMergeDistance;
  std::uint32_t other = p;
  Local apart{};
  const auto look = [&](std::uint32_t q, const Local& x) {
    const Local d = {x[0] - here[0], x[1] - here[1], x[2] - here[2]};
    const float squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared > nearest || q == p || bins.point(q).set != bins.point(p).set) return;
    if (squared == nearest && (other == p || bins.point(q).id > bins.point(other).id)) return;
    nearest = squared;
    other = q;
    apart = d;
  };
  bins.for_points(b, low, high, look);
  if (other == p) return false;
  pair = {p, other, apart};
  if (bins.point(other).id < bins.point(p).id) pair = {other, p, {-apart[0], -apart[1], -apart[2]}};
  return true;
}

}  // namespace

std::vector<Pair> find_pairs(const PointBins& bins, int threads) {
  std::vector<std::vector<Pair>> found(bins.blocks().size());
  parallel_for(threads, static_cast<std::int64_t>(found.size()), 4, [&](std::int64_t index) {
    const auto b = static_cast<std::size_t>(index);
    const std::uint32_t end = bins.last(b, bins.lattice().cells() - 1);
    Pair pair;
    for (std::uint32_t p = bins.first(b, 0); p < end; ++p)
      if (find_nearest(bins, b, p, pair)) found[b].push_back(pair);
  });
  std::vector<Pair> candidates;
  for (const auto& list : found) candidates.insert(candidates.end(), list.begin(), list.end());
  const auto ids = [&](const Pair& p) {
    return std::make_pair(bins.point(p.kept).id, bins.point(p.removed).id);
  };
  std::sort(candidates.begin(), candidates.end(),
            [&](const Pair& a, const Pair& b) { return ids(a) < ids(b); });
  std::vector<char> selected(bins.size(), 0);
  std::vector<Pair> pairs;
  for (const Pair& p : candidates) {
    if (selected[p.kept] != 0 || selected[p.removed] != 0) continue;
    selected[p.kept] = selected[p.removed] = 1;
    pairs.push_back(p);
  }
  return pairs;
}

template <class Real>
Vec3 merge_points(const std::vector<Pair>& pairs, const PointBins& bins, std::vector<ParticleSet<Real>>& sets,
                  const std::vector<double>& mass) {
  Vec3 change = Vec3::Zero();
  std::vector<PointValues> lists;
  for (const auto& set : sets) lists.emplace_back(set.layout());
  for (const Pair& pair : pairs) {
    const std::size_t s = bins.point(pair.kept).set;
    ParticleSet<Real>& set = sets[s];
    const PointValues& values = lists[s];
    std::vector<double> a(values.count());
    std::vector<double> b(values.count());
    const PointSlot kept = bins.point(pair.kept).slot;
    const PointSlot removed = bins.point(pair.removed).slot;
    const double share_a = set.share(kept.tile, kept.lane);
    const double share_b = set.share(removed.tile, removed.lane);
    const double share = share_a + share_b;
    const Vec3 before =
        share_a * set.velocity(kept.tile, kept.lane) + share_b * set.velocity(removed.tile, removed.lane);
    values.read(set, kept, a.data());
    values.read(set, removed, b.data());
    for (std::size_t v = 0; v < a.size(); ++v) a[v] = (share_a * a[v] + share_b * b[v]) / share;
    values.renormalize(a.data());
    values.write(set, kept, a.data());
    set.template values<Real>(kept.tile, Field::kShare)[kept.lane] = static_cast<Real>(share);
    const Vec3 apart(static_cast<double>(pair.apart[0]), static_cast<double>(pair.apart[1]),
                     static_cast<double>(pair.apart[2]));
    set.place(kept, set.position(kept.tile, kept.lane) + share_b / share * bins.lattice().r * apart);
    set.remove(removed);
    change += mass[s] * (share * set.velocity(kept.tile, kept.lane) - before);
  }
  return change;
}

template Vec3 merge_points(const std::vector<Pair>&, const PointBins&, std::vector<ParticleSet<float>>&,
                           const std::vector<double>&);
template Vec3 merge_points(const std::vector<Pair>&, const PointBins&, std::vector<ParticleSet<double>>&,
                           const std::vector<double>&);

}  // namespace lather::mpm::resample
