#include "sim/study/needs.h"

#include <algorithm>
#include <chrono>

#include "sim/plan/stages.h"
#include "sim/simulation.h"

namespace lather::study {
namespace {

/// Whether the time of that stage is known.
bool is_timed(const std::string& name) {
  for (int i = 0; i < kStageCount; ++i)
    if (name == kStageNames[static_cast<std::size_t>(i)]) return timed(static_cast<Stage>(i));
  return false;
}

double seconds_in(const std::vector<StageTime>& stages, const std::string& name) {
  const auto found =
      std::find_if(stages.begin(), stages.end(), [&](const StageTime& s) { return s.name == name; });
  return found == stages.end() ? 0 : found->seconds;
}

}  // namespace

SceneNeeds needs_of(const Plan& plan, int threads, double seconds) {
  const auto simulation = Simulation::create(plan, threads);
  const auto start = std::chrono::steady_clock::now();
  bool stopped = false;
  const auto go_on = [&](const Progress&) {
    stopped = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds;
    return !stopped;
  };
  for (int index = 0; index < plan.frames && !stopped; ++index) simulation->step_to_frame(index, go_on);
  const std::vector<StageTime>& spent = simulation->report().stages;

  SceneNeeds needs;
  needs.materials = plan.materials;
  double all = 0;
  for (const StageTime& s : spent) all += s.seconds;
  for (const std::string& name : plan.stages) {
    StageNeed need{name, std::nullopt};
    if (is_timed(name) && all > 0) need.share = seconds_in(spent, name) / all;
    needs.stages.push_back(std::move(need));
  }
  for (const StageTime& s : spent)
    if (s.seconds > 0 && std::find(plan.stages.begin(), plan.stages.end(), s.name) == plan.stages.end())
      needs.idle.push_back(s.name);
  return needs;
}

}  // namespace lather::study
