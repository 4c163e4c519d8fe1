#include "sim/study/bench/machine_peak.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "sim/study/bench/peak_kernels.h"

namespace lather::study {
namespace {

constexpr int kRuns = 7;
constexpr double kLeast = 0.03;  // s, of one run

/// Largest amount per second over several runs of work(repeats), each of which does `amount` a repeat.
template <class Work>
double best_rate(double amount, const Work& work) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [&](std::int64_t repeats) {
    const auto start = Clock::now();
    volatile double kept = static_cast<double>(work(repeats));
    (void)kept;
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::int64_t repeats = 1;
  while (seconds(repeats) < kLeast) repeats *= 2;
  double best = 0;
  for (int run = 0; run < kRuns; ++run)
    best = std::max(best, amount * static_cast<double>(repeats) / seconds(repeats));
  return best;
}

template <class Real>
double multiply_add_rate(KernelLevel level) {
  const PeakKernels<Real>& kernels = peak_kernels<Real>(level);
  return best_rate(kernels.operations,
                   [&](std::int64_t repeats) { return kernels.multiply_add(repeats, Real(0.5), Real(1)); });
}

double read_rate(KernelLevel level, std::size_t bytes) {
  const std::vector<float> numbers(bytes / sizeof(float), 1.0F);
  const PeakKernels<float>& kernels = peak_kernels<float>(level);
  return best_rate(static_cast<double>(bytes), [&](std::int64_t repeats) {
    float sum = 0;
    for (std::int64_t r = 0; r < repeats; ++r)
      sum += kernels.sum(numbers.data(), static_cast<std::int64_t>(numbers.size()));
    return sum;
  });
}

}  // namespace

MachinePeak measure_peak(KernelLevel level) {
  constexpr std::size_t kKiB = 1024;
  MachinePeak peak;
  peak.fma_gflops = 1e-9 * multiply_add_rate<float>(level);
  peak.fma_gflops_double = 1e-9 * multiply_add_rate<double>(level);
  peak.l2_gbs = 1e-9 * read_rate(level, 512 * kKiB);
  peak.dram_gbs = 1e-9 * read_rate(level, 256 * kKiB * kKiB);
  return peak;
}

}  // namespace lather::study
