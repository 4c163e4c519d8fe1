#include "sim/study/bench/bench.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "sim/simulation.h"
#include "sim/study/bench/trends.h"

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

/// Goes on by so many steps, over frames if need be; what measuring these takes is not counted.
Lap advance(Simulation& simulation, int steps) {
  const Report& report = simulation.report();
  const double seconds = report.wall_seconds;
  const auto point_steps = static_cast<double>(report.point_steps);
  int left = steps;
  const auto count = [&](const Progress&) { return --left > 0; };
  while (left > 0) simulation.step_to_frame(static_cast<int>(report.frames.size()), count);
  return {report.wall_seconds - seconds, static_cast<double>(report.point_steps) - point_steps};
}

/// Shares of the stages in the time since the report was `before`.
void share_out(const Report& before, const Report& after, BenchResult& result) {
  const double step = after.wall_seconds - before.wall_seconds;
  double all = 0;
  for (std::size_t i = 0; i < after.stages.size(); ++i) {
    const StageTime none;
    const StageTime& was = i < before.stages.size() ? before.stages[i] : none;
    const StageTime& now = after.stages[i];
    const double seconds = now.seconds - was.seconds;
    if (seconds <= 0) continue;
    result.stages.push_back({now.name, seconds, (now.serial_seconds - was.serial_seconds) / step});
    all += seconds;
  }
  for (StageShare& s : result.stages) s.share /= all;
  result.serial_share = (after.serial_seconds - before.serial_seconds) / step;
}

/// Bytes of the heap in use: in its arenas, and mapped for what is large.
std::uint64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

int steps_of_round(const BenchCase& bench, const BenchRequest& request, const Lap& warm_up) {
  if (bench.steps > 0) return bench.steps;
  const double fitting = request.seconds / kRounds / (warm_up.seconds / kWarmUp);
  return static_cast<int>(std::clamp(fitting, 1.0, kMostSteps));
}

}  // namespace

BenchResult run_bench(const BenchCase& bench, const BenchRequest& request) {
  const Plan plan = make_plan(bench.scene(request.points), Choices{request.kernel_level});
  auto simulation = Simulation::create(plan, request.threads);
  BenchResult result;
  result.name = bench.name;
  result.points = plan.points;
  result.threads = simulation->report().threads;
  result.kernel_level = request.kernel_level;
  result.bytes_per_point = plan.materials.front().bytes_per_point;
  while (simulation->report().simulated_time < bench.start) advance(*simulation, kWarmUp);
  const int steps = steps_of_round(bench, request, advance(*simulation, kWarmUp));
  const std::uint64_t heap = heap_bytes();
  const Report before = simulation->report();
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
  share_out(before, simulation->report(), result);
  simulation.reset();
  result.memory_bytes = heap - heap_bytes();
  return result;
}

Object to_json(const MachinePeak& peak, KernelLevel level, const std::vector<BenchResult>& results) {
  const Object machine = {{"cores", static_cast<std::int64_t>(std::thread::hardware_concurrency())},
                          {"kernel_level", to_string(level)},
                          {"fma_gflops", peak.fma_gflops},
                          {"fma_gflops_double", peak.fma_gflops_double},
                          {"l2_gbs", peak.l2_gbs},
                          {"dram_gbs", peak.dram_gbs}};
  Array cases;
  for (const BenchResult& r : results) {
    Object stages;
    Object serial;
    for (const StageShare& s : r.stages) {
      stages.emplace_back(s.name, s.share);
      if (s.serial > 0) serial.emplace_back(s.name, s.serial);
    }
    cases.emplace_back(Object{{"name", r.name},
                              {"points", static_cast<std::int64_t>(r.points)},
                              {"threads", static_cast<std::int64_t>(r.threads)},
                              {"kernel_level", to_string(r.kernel_level)},
                              {"steps", static_cast<std::int64_t>(r.steps)},
                              {"point_steps_per_second", r.point_steps_per_second},
                              {"slowest", r.slowest},
                              {"fastest", r.fastest},
                              {"bytes_per_point", static_cast<std::int64_t>(r.bytes_per_point)},
                              {"memory_bytes", static_cast<std::int64_t>(r.memory_bytes)},
                              {"stages", std::move(stages)},
                              {"serial_share", r.serial_share},
                              {"serial_stages", std::move(serial)}});
  }
  Array faster;
  for (const Speedup& s : speedups(results))
    faster.emplace_back(Object{{"name", s.name},
                               {"points", static_cast<std::int64_t>(s.points)},
                               {"threads", static_cast<std::int64_t>(s.threads)},
                               {"speedup", s.speedup}});
  Array growing;
  for (const Growth& g : growths(results))
    growing.emplace_back(Object{{"name", g.name},
                                {"threads", static_cast<std::int64_t>(g.threads)},
                                {"from", static_cast<std::int64_t>(g.from)},
                                {"to", static_cast<std::int64_t>(g.to)},
                                {"exponent", g.exponent}});
  return {{"version", version()},
          {"machine", machine},
          {"cases", std::move(cases)},
          {"speedups", std::move(faster)},
          {"growths", std::move(growing)}};
}

}  // namespace lather::study
