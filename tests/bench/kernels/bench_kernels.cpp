// Kernels and small whole steps, one by one, by Google Benchmark: time, and points a second.
//
//   bench_kernels [--level x86-64-v3] [options of Google Benchmark]

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "tests/bench/kernels/kernel_case.h"

/// Where instructions are counted: see tests/bench/instructions.
extern "C" [[gnu::noinline]] void lather_measured(const lather::bench::KernelWork& work) {
  work.run();
}

namespace lather::bench {
namespace {

void measure(benchmark::State& state, const KernelCase& kernel, KernelLevel level,
             std::optional<KernelWork>& work) {
  if (!work) {
    work = kernel.make(level);
    work->run();
  }
  for (auto unused : state) {
    (void)unused;
    lather_measured(*work);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * work->points);
  state.counters["points"] = static_cast<double>(work->points);
}

/// Takes "--level NAME" from the arguments.
KernelLevel take_level(int& argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], "--level") == 0) {
      const KernelLevel level = kernel_level_from_string(argv[i + 1]);
      for (int k = i; k + 2 <= argc; ++k) argv[k] = argv[k + 2];
      argc -= 2;
      return level;
    }
  return best_kernel_level();
}

int run(int argc, char** argv) {
  const KernelLevel level = take_level(argc, argv);
  if (!machine_has(level)) {
    std::fprintf(stderr, "bench_kernels: this machine lacks %s\n", to_string(level));
    return 2;
  }
  std::vector<KernelCase> cases;
  add_mpm_cases(cases);
  add_mlsrk_cases(cases);
  add_tensor_cases(cases);
  add_step_cases(cases);
  for (const KernelCase& c : cases)
    benchmark::RegisterBenchmark(
        c.name.c_str(), [c, level, work = std::optional<KernelWork>()](benchmark::State& state) mutable {
          measure(state, c, level, work);
        });
  benchmark::AddCustomContext("kernel_level", to_string(level));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace lather::bench

int main(int argc, char** argv) {
  try {
    return lather::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_kernels: %s\n", error.what());
    return 1;
  }
}
