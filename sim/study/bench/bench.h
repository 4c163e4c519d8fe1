#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/plan/plan.h"
#include "sim/scene/value.h"
#include "sim/study/bench/machine_peak.h"

/// How fast the solvers are on this machine, by standard cases, beside what its cores can do.
namespace lather::study {

struct BenchCase {
  std::string name;  ///< solver/kernel/…/precision, e.g. "mpm/cubic/flip/herschel-bulkley/float"
  /// A body of about so many points that deforms all over, in a domain that it never leaves.
  std::function<Scene(std::uint64_t points)> scene;
  /// Of a round, where what the case does recurs after so many; 0: as many as fit in its time.
  int steps = 0;
  double start = 0;  ///< s, simulated before anything is measured
};

/// All cases, the grid's first.
[[nodiscard]] const std::vector<BenchCase>& bench_cases();

/// The main case of a solver, and sizes that are far apart.
struct ScalingCase {
  std::string name;
  std::vector<std::uint64_t> points;
};
[[nodiscard]] const std::vector<ScalingCase>& scaling_cases();

struct BenchRequest {
  std::uint64_t points = 0;
  int threads = 1;  ///< 0: all cores
  KernelLevel kernel_level = best_kernel_level();
  double seconds = 2;  ///< of stepping, in all rounds; a round is a step at least
};

struct StageShare {
  std::string name;   ///< as in the report
  double share = 0;   ///< of the time in all stages, summed over threads
  double serial = 0;  ///< of the step: the stage runs on one thread while all others wait
};

struct BenchResult {
  std::string name;
  std::uint64_t points = 0;
  int threads = 0;
  KernelLevel kernel_level = KernelLevel::kV2;
  std::uint64_t steps = 0;            ///< that were measured
  double point_steps_per_second = 0;  ///< of all threads: the median round
  double slowest = 0;                 ///< round, point-steps/s
  double fastest = 0;
  int bytes_per_point = 0;         ///< of the state that a point carries
  std::uint64_t memory_bytes = 0;  ///< that the simulation holds after its first steps, all in all
  std::vector<StageShare> stages;  ///< in the order of the step, without those that took no time
  double serial_share = 0;         ///< of the step: that of all stages, and what lies between them
};

/// Runs a few steps to warm up, then five rounds that are measured. Throws as Simulation does.
[[nodiscard]] BenchResult run_bench(const BenchCase& bench, const BenchRequest& request);

/// {"version", "machine": {"cores", "kernel_level", "fma_gflops", "fma_gflops_double", "l2_gbs", "dram_gbs"},
/// "cases": [{"name", "points", "threads", "kernel_level", "steps", "point_steps_per_second", "slowest",
/// "fastest", "bytes_per_point", "memory_bytes", "stages": {name: share}, "serial_share", "serial_stages":
/// {name: share}}], "speedups": [{"name", "points", "threads", "speedup"}], "growths": [{"name", "threads",
/// "from", "to", "exponent"}]}; the machine's rates are those of one core.
[[nodiscard]] Object to_json(const MachinePeak& peak, KernelLevel level,
                             const std::vector<BenchResult>& results);

}  // namespace lather::study
