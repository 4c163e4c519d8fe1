#pragma once

#include <omp.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

/// The one parallel loop. Work is split by index and every index writes its own results, so that nothing
/// depends on the number of threads or on the order in which they run.
namespace lather {

/// The time that the calling thread has spent in parallel loops, outermost ones only: what is left of a span
/// of time ran on one thread alone.
class ParallelTime {
 public:
  [[nodiscard]] static double seconds() { return total; }
  /// Whether the calling thread is in a parallel loop, be it of one thread.
  [[nodiscard]] static bool inside() { return nesting > 0 || omp_in_parallel() != 0; }

  ParallelTime() { ++nesting; }
  ~ParallelTime() {
    if (--nesting == 0) total += std::chrono::duration<double>(Clock::now() - start_).count();
  }
  ParallelTime(const ParallelTime&) = delete;
  ParallelTime& operator=(const ParallelTime&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  static inline constinit thread_local int nesting = 0;
  static inline constinit thread_local double total = 0;
};

/// Calls body(index) for 0 <= index < count on `threads` threads, `grain` indices at a time; rethrows the
/// first exception.
template <class Body>
void parallel_for(int threads, std::int64_t count, int grain, const Body& body) {
  const ParallelTime time;
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, grain) num_threads(threads) if (threads > 1)
  for (std::int64_t i = 0; i < count; ++i) {
    try {
      body(i);
    } catch (...) {
#pragma omp critical(lather_parallel_failure)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Index of the calling thread within parallel_for, for scratch memory only.
inline int thread_index() {
  return omp_get_thread_num();
}

/// Folds part(chunk) for 0 <= chunk < chunks in ascending order: same bits for any number of threads.
template <class Value, class Part, class Fold>
Value parallel_fold(int threads, std::int64_t chunks, Value start, const Part& part, const Fold& fold) {
  std::vector<Value> parts(static_cast<std::size_t>(chunks), start);
  parallel_for(threads, chunks, 1, [&](std::int64_t c) { parts[static_cast<std::size_t>(c)] = part(c); });
  for (const Value& p : parts) fold(start, p);
  return start;
}

}  // namespace lather
