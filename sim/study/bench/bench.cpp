#include "sim/study/bench/bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "sim/scene/value.h"
#include "sim/simulation.h"

namespace lather::study {
namespace {

constexpr int kWarmUp = 4;  // steps: the first sorts, and finds memory for everything
constexpr int kRounds = 5;
constexpr double kMostSteps = 200;  // of a round

/// Seconds and point-steps of a number of steps.
struct Lap {
  double seconds = 0;
  double point_steps = 0;
};

Lap advance(Simulation& simulation, int steps) {
  const Report& report = simulation.report();
  const double seconds = report.wall_seconds;
  const auto point_steps = static_cast<double>(report.point_steps);
  int left = steps;
  simulation.step_to_frame(1, [&](const Progress&) { return --left > 0; });
  return {report.wall_seconds - seconds, static_cast<double>(report.point_steps) - point_steps};
}

std::vector<double> stage_seconds(const Report& report) {
  std::vector<double> seconds;
  for (const StageTime& s : report.stages) seconds.push_back(s.seconds);
  return seconds;
}

std::vector<StageShare> stage_shares(const Report& report, const std::vector<double>& before) {
  std::vector<StageShare> shares;
  double all = 0;
  for (std::size_t i = 0; i < report.stages.size(); ++i) {
    const double seconds = report.stages[i].seconds - (i < before.size() ? before[i] : 0);
    if (seconds <= 0) continue;
    shares.push_back({report.stages[i].name, seconds});
    all += seconds;
  }
  for (StageShare& s : shares) s.share /= all;
  return shares;
}

int steps_of_round(const BenchCase& bench, const BenchRequest& request, const Lap& warm_up) {
  if (bench.steps > 0) return bench.steps;
  const double fitting = request.seconds / kRounds / (warm_up.seconds / kWarmUp);
  return static_cast<int>(std::clamp(fitting, 1.0, kMostSteps));
}

}  // namespace

BenchResult run_bench(const BenchCase& bench, const BenchRequest& request) {
  const Plan plan = make_plan(bench.scene(request.points), Choices{request.kernel_level});
  const auto simulation = Simulation::create(plan, request.threads);
  BenchResult result;
  result.name = bench.name;
  result.points = plan.points;
  result.threads = simulation->report().threads;
  result.kernel_level = request.kernel_level;
  result.bytes_per_point = plan.materials.front().bytes_per_point;
  const int steps = steps_of_round(bench, request, advance(*simulation, kWarmUp));
  const std::vector<double> before = stage_seconds(simulation->report());
  std::array<double, kRounds> rates{};
  for (double& rate : rates) {
    const Lap lap = advance(*simulation, steps);
    rate = lap.point_steps / lap.seconds;
  }
  std::sort(rates.begin(), rates.end());
  result.steps = static_cast<std::uint64_t>(kRounds) * static_cast<std::uint64_t>(steps);
  result.point_steps_per_second = rates[kRounds / 2];
  result.slowest = rates.front();
  result.fastest = rates.back();
  result.stages = stage_shares(simulation->report(), before);
  return result;
}

std::string to_json(const MachinePeak& peak, KernelLevel level, const std::vector<BenchResult>& results) {
  const Object machine = {{"cores", static_cast<std::int64_t>(std::thread::hardware_concurrency())},
                          {"kernel_level", to_string(level)},
                          {"fma_gflops", peak.fma_gflops},
                          {"fma_gflops_double", peak.fma_gflops_double},
                          {"l2_gbs", peak.l2_gbs},
                          {"dram_gbs", peak.dram_gbs}};
  Array cases;
  for (const BenchResult& r : results) {
    Object stages;
    for (const StageShare& s : r.stages) stages.emplace_back(s.name, s.share);
    cases.emplace_back(Object{{"name", r.name},
                              {"points", static_cast<std::int64_t>(r.points)},
                              {"threads", static_cast<std::int64_t>(r.threads)},
                              {"kernel_level", to_string(r.kernel_level)},
                              {"steps", static_cast<std::int64_t>(r.steps)},
                              {"point_steps_per_second", r.point_steps_per_second},
                              {"slowest", r.slowest},
                              {"fastest", r.fastest},
                              {"bytes_per_point", static_cast<std::int64_t>(r.bytes_per_point)},
                              {"stages", std::move(stages)}});
  }
  return write_json(Object{{"version", version()}, {"machine", machine}, {"cases", std::move(cases)}});
}

}  // namespace lather::study
