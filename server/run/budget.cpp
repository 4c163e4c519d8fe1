#include "server/run/budget.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "render/render.h"
#include "server/run/run.h"
#include "sim/scene/quality.h"
#include "sim/simulation.h"
#include "sim/study/cpu_clock.h"
#include "sim/study/forecast.h"

namespace lather::server {
namespace {

/// Of a picture's samples, s on one core.
constexpr double kSecondsPerSample = 3e-8;

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

/// A quality with what it should take.
struct Candidate {
  const QualityPoint* point = nullptr;
  double seconds = 0;
};

Candidate candidate(const Scene& scene, const QualityPoint& point, int threads, const DrawingCost& drawing) {
  return {&point, forecast_seconds(make_plan(with_quality(scene, point.quality)), threads, drawing)};
}

/// The most accurate one in time; else the cheapest, by what was measured of it: where drawing takes most of
/// the time, trials differ by noise alone.
Candidate in_time(const Scene& scene, int threads, const DrawingCost& drawing) {
  std::vector<const QualityPoint*> points;
  for (const QualityPoint& p : quality_points(scene.solver)) points.push_back(&p);
  std::stable_sort(points.begin(), points.end(), [](const QualityPoint* a, const QualityPoint* b) {
    return a->error_factor < b->error_factor;
  });
  Candidate cheapest;
  for (const QualityPoint* p : points) {
    const Candidate tried = candidate(scene, *p, threads, drawing);
    if (tried.seconds <= scene.budget->seconds) return tried;
    if (cheapest.point == nullptr || p->cost_factor < cheapest.point->cost_factor) cheapest = tried;
  }
  return cheapest;
}

/// The cheapest one that is accurate enough.
Candidate accurate_enough(const Scene& scene, int threads, const DrawingCost& drawing) {
  const QualityPoint* cheapest = nullptr;
  double least = 1e300;
  for (const QualityPoint& p : quality_points(scene.solver)) {
    least = std::min(least, p.error);
    if (p.error <= scene.budget->error && (cheapest == nullptr || p.cost_factor < cheapest->cost_factor))
      cheapest = &p;
  }
  if (cheapest == nullptr)
    throw InputError(
        {{"/budget/error", write_json(Value(scene.budget->error)), "at least " + write_json(Value(least)),
          "No quality was as accurate on every exact case; take a larger error, and a finer "
          "\"spacing\" where the scene itself needs one."}});
  return candidate(scene, *cheapest, threads, drawing);
}

DrawingCost draw_twice(const Plan& plan, const Frame& frame, int threads, const std::string& backend) {
  const auto renderer = render::Renderer::create(render::backend_from_string(backend), plan.scene.look,
                                                 plan.scene.output, threads);
  DrawingCost cost;
  for (int i = 0; i < 2; ++i) {  // the first one makes shaders
    const auto start = std::chrono::steady_clock::now();
    const double before = study::cpu_seconds();
    static_cast<void>(renderer->draw_png(frame, {}));
    cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    cost.cpu = study::cpu_seconds() - before;
  }
  return cost;
}

}  // namespace

DrawingCost measure_drawing(const Plan& plan, int threads, const std::string& backend) {
  const auto simulation = Simulation::create(plan, threads);
  simulation->step_to_frame(0, [](const Progress&) { return true; });
  const Frame frame = simulation->frame();
  DrawingCost cost;
  std::exception_ptr failure;
  std::thread([&] {
    try {
      cost = draw_twice(plan, frame, thread_count(threads), backend);
    } catch (...) {
      failure = std::current_exception();
    }
  }).join();
  if (failure) std::rethrow_exception(failure);
  return cost;
}

DrawingCost estimate_drawing(const Output& output) {
  const double samples =
      static_cast<double>(output.width) * output.height * output.supersampling * output.supersampling;
  return {kSecondsPerSample * samples, kSecondsPerSample * samples};
}

double forecast_seconds(const Plan& plan, int threads, const DrawingCost& drawing) {
  const study::Forecast steps = study::forecast(plan, threads);
  // Beside each other, until the cores are full.
  const double together = (steps.cpu + plan.frames * drawing.cpu) / thread_count(threads);
  return std::max({steps.wall, plan.frames * drawing.wall, together});
}

Plan plan_in_budget(const Scene& scene, int threads, const DrawingCost& drawing) {
  if (!scene.budget) return make_plan(scene);
  const bool timed = scene.budget->seconds > 0;
  const Candidate chosen =
      timed ? in_time(scene, threads, drawing) : accurate_enough(scene, threads, drawing);
  Scene resolved = with_quality(scene, chosen.point->quality);
  resolved.quality = Quality::kOwn;  // the choice is the plan's
  Choices choices;
  choices.budget = BudgetChoice{chosen.point->quality, chosen.seconds, chosen.point->error};
  Plan plan = make_plan(resolved, choices);
  if (timed && chosen.seconds > scene.budget->seconds)
    plan.warnings.push_back("The run should take " + seconds_text(chosen.seconds) +
                            " at the cheapest quality, \"" + chosen.point->name +
                            "\", more than its budget of " + seconds_text(scene.budget->seconds) +
                            "; take a larger spacing, fewer frames or smaller pictures.");
  return plan;
}

Plan plan_in_budget(const Scene& scene, int threads, const std::string& backend) {
  Plan plan = make_plan(scene);
  if (!scene.budget) return plan;
  study::require_trial(plan);
  return plan_in_budget(scene, threads, measure_drawing(plan, threads, backend));
}

}  // namespace lather::server
