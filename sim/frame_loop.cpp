#include "sim/frame_loop.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sim/math/parallel.h"
#include "sim/plan/step_bound.h"
#include "sim/report/energy_balance.h"
#include "sim/surface/skin.h"

namespace lather {

std::string with_unit(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g%s%s", value, *unit != 0 ? " " : "", unit);
  return text;
}

FrameLoop::FrameLoop(const Plan& plan, int threads) : plan_(plan), threads_(threads) {
  report_.scene_name = plan.scene.name;
  report_.scene_hash = scene_hash(plan.scene);
  report_.version = version();
  report_.kernel_level = to_string(plan.choices.kernel_level);
  report_.threads = threads;
}

bool FrameLoop::step_to_frame(int index, const std::function<bool(const Progress&)>& heartbeat) {
  if (index <= measured_frame_) return true;
  const double target = index / plan_.scene.frame_rate;
  while (moment().time < target) {
    before_step();
    const double left = target - moment().time;
    const double steps = steps_for(left, step_limit());
    step(left / steps);
    if (steps == 1) set_time(target);
    after_step();
    if (!heartbeat({index, moment().time, last_step_, moment().step})) {
      add_up();
      return false;
    }
  }
  record(index);
  return true;
}

void FrameLoop::step(double dt) {
  const auto start = std::chrono::steady_clock::now();
  const double in_loops = ParallelTime::seconds();
  const std::uint64_t points = point_count();
  const Moment before = moment();
  const StepExtremes seen = take_step(dt);
  check(seen, before, dt);
  last_step_ = dt;
  report_.smallest_time_step = report_.steps == 0 ? dt : std::min(report_.smallest_time_step, dt);
  report_.largest_time_step = std::max(report_.largest_time_step, dt);
  report_.largest_cfl = std::max(report_.largest_cfl, seen.largest_cells);
  report_.steps = moment().step;
  report_.point_steps += points;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  report_.wall_seconds += took.count();
  report_.serial_seconds += took.count() - (ParallelTime::seconds() - in_loops);
}

/// Throws when the state is no longer sound.
void FrameLoop::check(const StepExtremes& seen, const Moment& start, double dt) const {
  SimulationError::Details d;
  d.step = static_cast<long long>(start.step);
  d.time = start.time;
  if (!seen.finite) {
    d.kind = "non-finite";
    d.quantity = "a point's velocity, J, elastic strain or deformation";
    d.value = "not a finite number";
  } else if (seen.collapsed) {
    d.kind = "runaway";
    d.quantity = "a point's volume ratio J";
    d.value = "zero or negative";
  } else if (seen.largest_cells > 1) {
    d.kind = "runaway";
    d.quantity = "a point's speed";
    d.value =
        with_unit(seen.max_speed, "m/s") + " (" + with_unit(seen.largest_cells, "cells in one step") + ")";
  } else if (seen.carried_out) {
    d.kind = "grip";
    d.quantity = "a point that a grip drives";
    d.value = "outside the domain";
    d.advice = "End the grip earlier (/grips), move it less far, or enlarge /domain.";
    throw SimulationError(d);
  } else {
    return;
  }
  d.advice = advice(dt);
  throw SimulationError(d);
}

std::string FrameLoop::advice(double dt) const {
  const Numerics& n = plan_.scene.numerics;
  return n.time_step > 0 ? "Lower /numerics/time_step from " + with_unit(dt, "s") + "; the step bound is " +
                               with_unit(plan_.step_bound, "s") + "."
                         : "Lower /numerics/safety_factor from " + with_unit(n.safety_factor, "") + ".";
}

void FrameLoop::check_energy(const FrameMeasure& m) const {
  const Scene& scene = plan_.scene;
  if (report_.frames.empty() || is_driven(scene)) return;
  const double was = total_energy(scene, report_.frames.front());
  const double is = total_energy(scene, m);
  if (is <= (1 + scene.numerics.allowed_energy_gain) * was + rounding_energy(scene, m)) return;
  SimulationError::Details d;
  d.kind = "energy";
  d.step = static_cast<long long>(m.step);
  d.time = m.time;
  d.quantity = "the material's energy";
  d.value = with_unit(is, "J") + ", where it began with " + with_unit(was, "J") + " and nothing gave it any";
  d.advice = advice(report_.largest_time_step) + " Or allow it: /numerics/allowed_energy_gain is " +
             with_unit(scene.numerics.allowed_energy_gain, "") + ".";
  throw SimulationError(d);
}

void FrameLoop::record(int index) {
  FrameMeasure m = measure_state(index);
  m.frame = index;
  m.time = moment().time;
  m.step = moment().step;
  check_energy(m);
  report_.frames.push_back(m);
  measured_frame_ = index;
  add_up();
}

void FrameLoop::add_up() {
  report_.simulated_time = moment().time;
  report_.warnings = warnings();
  if (report_.wall_seconds > 0)
    report_.point_steps_per_second = static_cast<double>(report_.point_steps) / report_.wall_seconds;
  report_.stages.clear();
  for (const std::string& name : plan_.stages)
    for (int s = 0; s < kStageCount; ++s)
      if (name == kStageNames[static_cast<std::size_t>(s)] && timed(static_cast<Stage>(s)))
        report_.stages.push_back(
            {name, clock().seconds(static_cast<Stage>(s)), clock().serial_seconds(static_cast<Stage>(s))});
}

Frame FrameLoop::with_skins(Frame frame) const {
  if (plan_.scene.wants_skin()) frame.skins = skins_.empty() ? skins_of(frame, threads_) : skins_;
  return frame;
}

void FrameLoop::measure_skins(const Frame& frame, FrameMeasure& m) {
  skins_ = skins_of(frame, threads_);
  m.skin_volume = 0;
  for (const FrameSkin& skin : skins_) *m.skin_volume += skin.volume;
}

std::string FrameLoop::checkpoint_key() const {
  Scene of_any_length = plan_.scene;  // so that a finished run can be made longer
  of_any_length.duration = 0;
  return scene_hash(of_any_length) + ' ' + report_.kernel_level + ' ' + report_.version;
}

}  // namespace lather
