#include "sim/study/forecast.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "sim/simulation.h"
#include "sim/study/cpu_clock.h"

namespace lather::study {
namespace {

constexpr int kWarmUp = 3;      // steps: the first sorts, and finds memory for everything
constexpr int kLeastSteps = 8;  // of a trial

/// What has been spent so far, s.
struct Spent {
  double wall = 0;
  double cpu = 0;
};

Spent now() {
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(wall).count(), cpu_seconds()};
}

/// Share of the run that an emitter's points are there for, on average.
double share_of_run(const Emitter& e, double duration) {
  const double last = e.stream ? e.end : e.start + (e.count - 1) * e.interval;
  const double begin = std::min(e.start, duration);
  const double end = std::clamp(last, begin, duration);
  return (duration - 0.5 * (begin + end)) / duration;
}

}  // namespace

double planned_point_steps(const Plan& plan) {
  double share = 0;
  for (const Emitter& e : plan.scene.emitters)
    share += share_of_run(e, plan.scene.duration) / static_cast<double>(plan.scene.emitters.size());
  const auto at_start = static_cast<double>(plan.points - plan.points_emitted);
  return static_cast<double>(plan.steps) * (at_start + share * static_cast<double>(plan.points_emitted));
}

void require_trial(const Plan& plan) {
  if (plan.points > kMostTrialPoints)
    throw InputError(
        {{"/budget", std::to_string(plan.points) + " points",
          "at most " + std::to_string(kMostTrialPoints) + " points",
          "How long a scene takes is found by a trial, and this one is too large to be tried. Give a "
          "\"quality\" in place of the budget."}});
}

Forecast forecast(const Plan& plan, int threads, double seconds) {
  require_trial(plan);
  const auto simulation = Simulation::create(plan, threads);
  const Report& report = simulation->report();
  const Spent start = now();
  simulation->step_to_frame(0, [](const Progress&) { return true; });
  Frame first = simulation->frame();
  const Spent framed = now();

  Spent warm = framed;
  std::uint64_t warm_point_steps = 0;
  bool stopped = false;
  const auto go_on = [&](const Progress& at) {
    if (at.step == kWarmUp) {
      warm = now();
      warm_point_steps = report.point_steps;
    }
    stopped = at.step >= kWarmUp + kLeastSteps && now().wall - warm.wall > seconds;
    return !stopped;
  };
  int frames = 0;  // that were reached, and measured, in the trial
  for (int index = 1; index < plan.frames && !stopped; ++index)
    if (simulation->step_to_frame(index, go_on)) ++frames;
  const Spent end = now();

  Forecast out;
  out.point_steps = planned_point_steps(plan);
  const Spent frame = {framed.wall - start.wall, framed.cpu - start.cpu};
  const auto stepped = static_cast<double>(report.point_steps - warm_point_steps);
  const double times = stepped > 0 ? out.point_steps / stepped : 0;
  const auto total = [&](double spent, double a_frame) {
    return times * std::max(0.0, spent - frames * a_frame) + plan.frames * a_frame;
  };
  out.wall = total(end.wall - warm.wall, frame.wall);
  out.cpu = total(end.cpu - warm.cpu, frame.cpu);
  return out;
}

}  // namespace lather::study
