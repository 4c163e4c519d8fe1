#pragma once

#include "sim/plan/plan.h"

/// How long a run will take, from a short trial of it.
namespace lather::study {

struct Forecast {
  double point_steps = 0;  ///< planned, of the whole run
  double wall = 0;         ///< s, in steps and in what is measured at every frame
  double cpu = 0;          ///< s of the process, likewise, all threads together
};

/// Points times steps: points that are emitted count from their release on, those of all emitters alike.
[[nodiscard]] double planned_point_steps(const Plan& plan);

/// Runs the first steps of the plan for about `seconds`, and takes all others to cost as much a point. What
/// that leaves out: steps that shrink because points have become fast, releases that wait, material that has
/// spread. `threads` = 0 takes all cores. Throws as Simulation does.
[[nodiscard]] Forecast forecast(const Plan& plan, int threads, double seconds = 0.3);

/// Throws InputError for a plan that is too large to be tried.
void require_trial(const Plan& plan);

/// Largest number of points that a trial is made of: it has to make them all.
inline constexpr std::uint64_t kMostTrialPoints = 2'000'000;

}  // namespace lather::study
