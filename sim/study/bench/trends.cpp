#include "sim/study/bench/trends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lather::study {
namespace {

/// By least squares.
double log_log_slope(const std::vector<const BenchResult*>& results) {
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (const BenchResult* r : results) {
    const auto points = static_cast<double>(r->points);
    const double log_points = std::log(points);
    const double log_seconds = std::log(points / r->fastest);
    x += log_points;
    y += log_seconds;
    xx += log_points * log_points;
    xy += log_points * log_seconds;
  }
  const auto n = static_cast<double>(results.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

std::vector<Speedup> speedups(const std::vector<BenchResult>& results) {
  std::vector<Speedup> found;
  for (const BenchResult& many : results) {
    if (many.threads == 1) continue;
    const auto one = std::find_if(results.begin(), results.end(), [&](const BenchResult& r) {
      return r.threads == 1 && r.name == many.name && r.points == many.points;
    });
    if (one != results.end())
      found.push_back({many.name, many.points, many.threads, many.fastest / one->fastest});
  }
  return found;
}

std::vector<Growth> growths(const std::vector<BenchResult>& results) {
  std::map<std::pair<std::string, int>, std::vector<const BenchResult*>> of_case;
  for (const BenchResult& r : results) of_case[{r.name, r.threads}].push_back(&r);
  std::vector<Growth> found;
  for (auto& [key, sizes] : of_case) {
    if (sizes.size() < 3) continue;
    std::sort(sizes.begin(), sizes.end(), [](const auto* a, const auto* b) { return a->points < b->points; });
    found.push_back(
        {key.first, key.second, sizes.front()->points, sizes.back()->points, log_log_slope(sizes)});
  }
  return found;
}

}  // namespace lather::study
