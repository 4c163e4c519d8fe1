#include <algorithm>
#include <cstdio>
#include <string>

#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"
#include "sim/scene/descriptor.h"
#include "sim/study/bench/bench.h"
#include "sim/study/bench/papers.h"
#include "sim/study/bench/trends.h"

namespace lather::server {
namespace {

using study::BenchCase;
using study::BenchRequest;
using study::BenchResult;
using study::MachinePeak;

/// Those of `all` whose names begin with one of the texts, each once, in their order; all where none is asked
/// for.
template <class Named>
std::vector<Named> chosen(const std::vector<Named>& all, const std::vector<std::string>& asked) {
  const auto begins = [](const Named& one, const std::string& text) { return one.name.rfind(text, 0) == 0; };
  for (const std::string& text : asked)
    if (std::none_of(all.begin(), all.end(), [&](const Named& one) { return begins(one, text); })) {
      std::vector<std::string> names;
      for (const Named& one : all) names.push_back(one.name);
      throw InputError({{"", text, descriptor::listed(names), "No case has a name that begins so."}});
    }
  std::vector<Named> cases;
  for (const Named& one : all)
    if (asked.empty() ||
        std::any_of(asked.begin(), asked.end(), [&](const std::string& text) { return begins(one, text); }))
      cases.push_back(one);
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

void print_machine(const MachinePeak& peak, KernelLevel level) {
  std::printf(
      "one core at %s: %.0f GFLOP/s in float, %.0f in double; reads %.0f GB/s from L2, %.0f GB/s from "
      "memory\n\n",
      to_string(level), peak.fma_gflops, peak.fma_gflops_double, peak.l2_gbs, peak.dram_gbs);
}

void print_head() {
  std::printf("%-42s %8s %7s %9s %9s %7s %9s %6s %7s %7s  %s\n", "case", "points", "threads", "M/s",
              "per core", "spread", "/GFLOP/s", "bytes", "MB", "serial", "stages");
}

/// M/s: millions of point-steps a second; /GFLOP/s: those of a core over its peak in the case's precision.
void print_row(const BenchResult& r, const MachinePeak& peak) {
  const bool is_double = r.name.find("/double") != std::string::npos;
  const double per_core = 1e-6 * r.point_steps_per_second / r.threads;
  std::printf("%-42s %8llu %7d %9.3f %9.3f %5.1f %% %9.4f %6d %7.1f %5.2f %%  %s\n", r.name.c_str(),
              static_cast<unsigned long long>(r.points), r.threads, 1e-6 * r.point_steps_per_second, per_core,
              100 * (r.fastest - r.slowest) / r.point_steps_per_second,
              per_core / (is_double ? peak.fma_gflops_double : peak.fma_gflops), r.bytes_per_point,
              1e-6 * static_cast<double>(r.memory_bytes), 100 * r.serial_share, main_stages(r).c_str());
  std::fflush(stdout);
}

/// Stages that run on one thread alone for a thousandth of the step or more, and what lies between stages.
std::string serial_stages(const BenchResult& result) {
  std::vector<study::StageShare> stages = result.stages;
  study::StageShare between{"between", 0, result.serial_share};
  for (const study::StageShare& s : stages) between.serial -= s.serial;
  stages.push_back(between);
  std::string text;
  for (const study::StageShare& s : stages) {
    if (s.serial < 1e-3) continue;
    char share[16];
    std::snprintf(share, sizeof share, " %.1f %%", 100 * s.serial);
    text += (text.empty() ? "" : ", ") + s.name + share;
  }
  return text;
}

/// What several rows say together, where there are such.
void print_trends(const std::vector<BenchResult>& results) {
  const std::vector<study::Speedup> speedups = study::speedups(results);
  if (!speedups.empty()) std::printf("\nspeed over one thread's, and what runs on one thread alone:\n");
  for (const study::Speedup& s : speedups) {
    const auto many = std::find_if(results.begin(), results.end(), [&](const BenchResult& r) {
      return r.name == s.name && r.points == s.points && r.threads == s.threads;
    });
    std::printf("%-42s %8llu %7d %6.3f  %s\n", s.name.c_str(), static_cast<unsigned long long>(s.points),
                s.threads, s.speedup, serial_stages(*many).c_str());
  }
  const std::vector<study::Growth> growths = study::growths(results);
  if (!growths.empty()) std::printf("\na step's time grows as points to the power of:\n");
  for (const study::Growth& g : growths)
    std::printf("%-42s %8llu to %llu points, threads %d: %6.3f\n", g.name.c_str(),
                static_cast<unsigned long long>(g.from), static_cast<unsigned long long>(g.to), g.threads,
                g.exponent);
}

std::vector<BenchResult> run_cases(const BenchOptions& options, KernelLevel level, const MachinePeak& peak) {
  std::vector<BenchResult> results;
  const auto run = [&](const BenchCase& c, std::uint64_t points) {
    for (const int threads : options.threads) {
      results.push_back(study::run_bench(c, BenchRequest{points, threads, level, options.seconds}));
      if (!options.json) print_row(results.back(), peak);
    }
  };
  if (options.scaling)
    for (const study::ScalingCase& c : chosen(study::scaling_cases(), options.cases))
      for (const std::uint64_t points : c.points) run(chosen(study::bench_cases(), {c.name}).front(), points);
  else
    for (const BenchCase& c : chosen(study::bench_cases(), options.cases))
      for (const std::uint64_t points : options.points) run(c, points);
  return results;
}

void print_paper_head() {
  std::printf("%-36s %8s %7s %7s %8s %8s %6s %8s %9s %9s %6s\n", "scene", "points", "threads", "from, s",
              "step, s", "printed", "steps", "M/s", "s/frame", "printed", "times");
}

/// times: how much faster than what is printed, the more expensive frame of a range.
void print_paper_row(const study::PaperRun& run) {
  const study::PaperScene& paper = run.paper;
  const BenchResult& r = run.result;
  const double seconds = run.seconds_per_frame();
  std::printf("%-36s %8llu %7d %7.3g %8.2e %8.2e %6llu %8.3f %9.4g ", paper.name.c_str(),
              static_cast<unsigned long long>(r.points), r.threads, paper.start, run.time_step,
              paper.time_step, static_cast<unsigned long long>(r.steps), 1e-6 * r.point_steps_per_second,
              seconds);
  if (paper.most)
    std::printf("%9.4g %6.3g  %s\n", *paper.most, *paper.most / seconds, paper.machine.c_str());
  else
    std::printf("%9s %6s  %s\n", "-", "-", paper.machine.c_str());
  std::fflush(stdout);
}

int papers_command(const BenchOptions& options, KernelLevel level, const MachinePeak& peak) {
  if (!options.json) print_paper_head();
  std::vector<study::PaperRun> runs;
  for (const study::PaperScene& paper :
       chosen(study::read_paper_scenes(read_text(options.papers)), options.cases)) {
    const Scene scene = read_scene({options.papers.parent_path() / paper.file, "paper", paper.set});
    for (const int threads : options.threads) {
      const BenchRequest request{0, threads, level, options.seconds};
      runs.push_back(
          {paper, study::step_of(scene), study::run_bench(study::paper_case(paper, scene), request)});
      if (!options.json) print_paper_row(runs.back());
    }
  }
  if (!options.json) return 0;
  std::vector<BenchResult> results;
  for (const study::PaperRun& run : runs) results.push_back(run.result);
  Object json = study::to_json(peak, level, results);
  json.emplace_back("papers", study::to_json(runs));
  std::printf("%s\n", write_json(json).c_str());
  return 0;
}

}  // namespace

int bench_command(const BenchOptions& options) {
  const KernelLevel level = level_of(options);
  const MachinePeak peak = study::measure_peak(level);
  if (!options.json) print_machine(peak, level);
  if (!options.papers.empty()) return papers_command(options, level, peak);
  if (!options.json) print_head();
  const std::vector<BenchResult> results = run_cases(options, level, peak);
  if (options.json)
    std::printf("%s\n", write_json(study::to_json(peak, level, results)).c_str());
  else
    print_trends(results);
  return 0;
}

}  // namespace lather::server
