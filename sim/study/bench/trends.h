#pragma once

#include "sim/study/bench/bench.h"

/// What several results of one case say together. They go by the fastest rounds, for other work on a machine
/// only ever slows one down.
namespace lather::study {

/// How much faster a case is with several threads than with one.
struct Speedup {
  std::string name;
  std::uint64_t points = 0;
  int threads = 0;
  double speedup = 0;
};

/// One for each result with several threads beside which there is one with the same points and one thread.
[[nodiscard]] std::vector<Speedup> speedups(const std::vector<BenchResult>& results);

/// How the time of a step grows with the points.
struct Growth {
  std::string name;
  int threads = 0;
  std::uint64_t from = 0;  ///< points, the fewest
  std::uint64_t to = 0;    ///< points, the most
  double exponent = 0;     ///< slope of the line that fits log time over log points best; 1: cost is linear
};

/// One for each case and number of threads with three numbers of points at least.
[[nodiscard]] std::vector<Growth> growths(const std::vector<BenchResult>& results);

}  // namespace lather::study
