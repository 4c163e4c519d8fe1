#pragma once

#include <omp.h>

#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

/// The one parallel loop. Work is split by index and every index writes its own results, so that nothing
/// depends on the number of threads or on the order in which they run.
namespace lather {

/// Calls body(index) for 0 <= index < count on `threads` threads, `grain` indices at a time; rethrows the
/// first exception.
template <class Body>
void parallel_for(int threads, std::int64_t count, int grain, const Body& body) {
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
