#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/study/tradeoff/front.h"
#include "sim/study/tradeoff/subject.h"

/// Error against computing time over a grid of settings.
namespace lather::study {

/// One choice of settings on one subject.
struct TradePoint {
  Settings settings;
  std::vector<Measure> measures;
  double error = 0;  ///< the largest measure; NaN where the run failed
  /// Of the process's CPU, all threads, in the steps of one run: the mean of each repetition's runs.
  std::vector<double> seconds;
  std::vector<double> wall;  ///< s, of the same
  std::uint64_t points = 0;  ///< at the end
  std::uint64_t steps = 0;
  std::uint64_t point_steps = 0;
  std::string failure;     ///< why it could not be run, "" if it was
  bool dominated = false;  ///< by another point of the subject

  /// Its error and its CPU time.
  [[nodiscard]] FrontPoint on_front() const;
};

struct TradeResult {
  std::string name;
  std::string error_of;
  bool exact = false;
  std::string solver;
  std::vector<TradePoint> points;  ///< the first is the scene as it is; scenes that are equal stand once
};

struct TradeRequest {
  int threads = 1;  ///< 0: all cores
  int repeats = 3;
  double least_seconds = 0;  ///< of CPU in a repetition, which runs a short scene again until then
  std::function<void(const std::string& what, int done, int all)> progress;  ///< called before each run
};

/// Runs the subject at all settings, the whole list `repeats` times, so that a machine whose speed drifts
/// drifts for all. A point that is no valid scene, or whose run fails, stays in the result with the reason.
/// Throws std::logic_error where a repetition gives another error than the first.
[[nodiscard]] TradeResult run_tradeoff(const Subject& subject, const std::vector<Settings>& settings,
                                       const TradeRequest& request);

/// A point of several subjects: its errors and costs over those of each one's first point, as their geometric
/// means. Settings that failed on any subject are left out.
struct MeanPoint {
  Settings settings;
  FrontPoint factor;  ///< error and cost over the first point's
};
[[nodiscard]] std::vector<MeanPoint> mean_points(const std::vector<TradeResult>& results);

/// {"name", "error_of", "exact", "solver", "points": [{"settings", "error", "measures": {…}, "seconds":
/// [...], "wall_seconds": [...], "points", "steps", "point_steps", "dominated", "failure"?}]}; an error that
/// is no number is null.
[[nodiscard]] Object to_json(const TradeResult& result);

/// What to_json() wrote. Throws InputError for anything else.
[[nodiscard]] TradeResult read_trade_result(const Value& json);

/// Median of at least one number.
[[nodiscard]] double median(std::vector<double> numbers);

}  // namespace lather::study
