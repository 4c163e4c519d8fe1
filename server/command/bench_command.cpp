#include <algorithm>
#include <cstdio>
#include <string>

#include "server/command/commands.h"
#include "sim/error.h"
#include "sim/scene/descriptor.h"
#include "sim/study/bench/bench.h"

namespace lather::server {
namespace {

using study::BenchCase;
using study::BenchRequest;
using study::BenchResult;
using study::MachinePeak;

/// Those whose names begin with one of the texts, each once, in the order of all cases.
std::vector<const BenchCase*> chosen(const std::vector<std::string>& asked) {
  std::vector<std::string> names;
  for (const BenchCase& c : study::bench_cases()) names.push_back(c.name);
  const auto begins = [](const std::string& name, const std::string& text) {
    return name.rfind(text, 0) == 0;
  };
  for (const std::string& text : asked)
    if (std::none_of(names.begin(), names.end(), [&](const std::string& n) { return begins(n, text); }))
      throw InputError({{"", text, descriptor::listed(names), "No case has a name that begins so."}});
  std::vector<const BenchCase*> cases;
  for (const BenchCase& c : study::bench_cases())
    if (asked.empty() || std::any_of(asked.begin(), asked.end(),
                                     [&](const std::string& text) { return begins(c.name, text); }))
      cases.push_back(&c);
  return cases;
}

KernelLevel level_of(const BenchOptions& options) {
  if (options.kernel_level.empty()) return best_kernel_level();
  const KernelLevel level = kernel_level_from_string(options.kernel_level);
  if (!machine_has(level))
    throw InputError({{"", options.kernel_level, std::string("up to ") + to_string(best_kernel_level()),
                       "This machine lacks the instructions of that kernel level."}});
  return level;
}

/// The largest shares, until they hold nine tenths.
std::string main_stages(const BenchResult& result) {
  std::vector<study::StageShare> stages = result.stages;
  std::stable_sort(stages.begin(), stages.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  std::string text;
  double held = 0;
  for (const study::StageShare& s : stages) {
    if (held > 0.9) break;
    held += s.share;
    char share[16];
    std::snprintf(share, sizeof share, " %.0f %%", 100 * s.share);
    text += (text.empty() ? "" : ", ") + s.name + share;
  }
  return text;
}

void print_head(const MachinePeak& peak, KernelLevel level) {
  std::printf(
      "one core at %s: %.0f GFLOP/s in float, %.0f in double; reads %.0f GB/s from L2, %.0f GB/s from "
      "memory\n\n",
      to_string(level), peak.fma_gflops, peak.fma_gflops_double, peak.l2_gbs, peak.dram_gbs);
  std::printf("%-42s %8s %7s %9s %9s %7s %9s %6s  %s\n", "case", "points", "threads", "M/s", "per core",
              "spread", "/GFLOP/s", "bytes", "stages");
}

/// M/s: millions of point-steps a second; /GFLOP/s: those of a core over its peak in the case's precision.
void print_row(const BenchResult& r, const MachinePeak& peak) {
  const bool is_double = r.name.find("/double") != std::string::npos;
  const double per_core = 1e-6 * r.point_steps_per_second / r.threads;
  std::printf("%-42s %8llu %7d %9.3f %9.3f %5.1f %% %9.4f %6d  %s\n", r.name.c_str(),
              static_cast<unsigned long long>(r.points), r.threads, 1e-6 * r.point_steps_per_second, per_core,
              100 * (r.fastest - r.slowest) / r.point_steps_per_second,
              per_core / (is_double ? peak.fma_gflops_double : peak.fma_gflops), r.bytes_per_point,
              main_stages(r).c_str());
  std::fflush(stdout);
}

}  // namespace

int bench_command(const BenchOptions& options) {
  const std::vector<const BenchCase*> cases = chosen(options.cases);
  const KernelLevel level = level_of(options);
  const MachinePeak peak = study::measure_peak(level);
  if (!options.json) print_head(peak, level);
  std::vector<BenchResult> results;
  for (const BenchCase* c : cases)
    for (const std::uint64_t points : options.points)
      for (const int threads : options.threads) {
        results.push_back(study::run_bench(*c, BenchRequest{points, threads, level, options.seconds}));
        if (!options.json) print_row(results.back(), peak);
      }
  if (options.json) std::printf("%s\n", study::to_json(peak, level, results).c_str());
  return 0;
}

}  // namespace lather::server
