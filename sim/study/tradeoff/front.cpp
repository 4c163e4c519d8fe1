#include "sim/study/tradeoff/front.h"

#include <algorithm>
#include <functional>

namespace lather::study {
namespace {

/// The most accurate point of the front that `allowed` lets through; the cheapest of equally accurate ones.
std::optional<std::size_t> most_accurate(const std::vector<FrontPoint>& points,
                                         const std::vector<std::size_t>& front,
                                         const std::function<bool(const FrontPoint&)>& allowed) {
  std::optional<double> least;
  for (const std::size_t i : front)
    if (allowed(points[i]) && (!least || points[i].error < *least)) least = points[i].error;
  for (const std::size_t i : front)  // from the cheapest on
    if (least && allowed(points[i]) && points[i].error * (1 - kEqualErrors) <= *least) return i;
  return std::nullopt;
}

}  // namespace

bool dominated(const FrontPoint& point, const FrontPoint& other) {
  const bool cheaper = other.dearest < point.cheapest;
  const bool clearly_better = other.error < point.error * (1 - kEqualErrors);
  return (cheaper && other.error * (1 - kEqualErrors) <= point.error) ||
         (clearly_better && other.cost <= point.cost);
}

std::vector<std::size_t> front_of(const std::vector<FrontPoint>& points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::none_of(points.begin(), points.end(),
                     [&](const FrontPoint& other) { return dominated(points[i], other); }))
      front.push_back(i);
  std::stable_sort(front.begin(), front.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].cost < points[b].cost; });
  return front;
}

std::optional<QualityPicks> pick_qualities(const std::vector<FrontPoint>& points,
                                           const FrontPoint& defaults) {
  const std::vector<std::size_t> front = front_of(points);
  const auto cheap_enough = std::find_if(front.begin(), front.end(), [&](std::size_t i) {
    return points[i].error <= kDraftError * defaults.error;
  });
  const auto standard =
      most_accurate(points, front, [&](const FrontPoint& p) { return p.cheapest <= defaults.dearest; });
  const auto fine =
      most_accurate(points, front, [&](const FrontPoint& p) { return p.cost <= kFineCost * defaults.cost; });
  const auto reference = most_accurate(points, front, [](const FrontPoint&) { return true; });
  if (cheap_enough == front.end() || !standard || !fine || !reference) return std::nullopt;
  return QualityPicks{*cheap_enough, *standard, *fine, *reference};
}

}  // namespace lather::study
