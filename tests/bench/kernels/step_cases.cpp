#include <algorithm>
#include <memory>

#include "sim/simulation.h"
#include "sim/study/bench/bench.h"
#include "tests/bench/kernels/kernel_case.h"

namespace lather::bench {
namespace {

constexpr std::uint64_t kPoints = 2000;
constexpr int kWarmUp = 4;  // steps, as in `lather bench`

void advance(Simulation& simulation, int steps) {
  simulation.step_to_frame(1, [&](const Progress&) { return --steps > 0; });
}

/// A single step says nothing of what happens once an interval, nor of a domain: where its corner lies
/// decides how so few points share blocks.
bool shows_in_a_step(const std::string& name) {
  return name.find("/resampling/") == std::string::npos && name.find("/huge-domain/") == std::string::npos;
}

}  // namespace

Scene bench_scene(const std::string& name, std::uint64_t points) {
  const std::vector<study::BenchCase>& cases = study::bench_cases();
  return std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.name == name; })
      ->scene(points);
}

void add_step_cases(std::vector<KernelCase>& cases) {
  for (const study::BenchCase& c : study::bench_cases()) {
    if (!shows_in_a_step(c.name)) continue;
    cases.push_back({"step/" + c.name, [name = c.name](KernelLevel level) {
                       const Plan plan = make_plan(bench_scene(name, kPoints), Choices{level});
                       const std::shared_ptr<Simulation> simulation = Simulation::create(plan, 1);
                       advance(*simulation, kWarmUp);
                       return KernelWork{static_cast<std::int64_t>(plan.points),
                                         [simulation] { advance(*simulation, 1); }};
                     }});
  }
}

}  // namespace lather::bench
