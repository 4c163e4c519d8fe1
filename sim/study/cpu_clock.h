#pragma once

#include <ctime>

namespace lather::study {

/// Time that the process has had on its cores, s: what other programs take is not in it.
[[nodiscard]] inline double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace lather::study
