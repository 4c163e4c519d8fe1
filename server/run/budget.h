#pragma once

#include "sim/plan/plan.h"

/// A scene's budget, resolved: which quality keeps it.
namespace lather::server {

/// What a picture takes, s.
struct DrawingCost {
  double wall = 0;
  double cpu = 0;  ///< all threads together
};

/// Draws the scene's first frame to see. Makes a drawing context on a thread of its own.
[[nodiscard]] DrawingCost measure_drawing(const Plan& plan, int threads, const std::string& backend);

/// By the number of samples, as on one core of the machine of docs/performance.md; for a process that does
/// not draw itself.
[[nodiscard]] DrawingCost estimate_drawing(const Output& output);

/// Wall time of a whole run, s: steps and pictures share the cores.
[[nodiscard]] double forecast_seconds(const Plan& plan, int threads, const DrawingCost& drawing);

/// The plan of a scene. With a budget of seconds: at the most accurate quality that a trial of each says will
/// be done in time; where none will, at the cheapest one and with a warning. With one of an error: at the
/// cheapest whose largest error on exact cases is no larger; throws InputError where there is none. Trials
/// take some tenths of a second each. Without a budget it is make_plan().
[[nodiscard]] Plan plan_in_budget(const Scene& scene, int threads, const DrawingCost& drawing);
/// The same, with what drawing takes as measured here; nothing is drawn for a scene without a budget.
[[nodiscard]] Plan plan_in_budget(const Scene& scene, int threads, const std::string& backend);

}  // namespace lather::server
