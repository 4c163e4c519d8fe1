#include "server/run/run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <new>
#include <thread>
#include <utility>

#include "render/render.h"
#include "server/artifacts/whole_file.h"
#include "server/run/checkpoint_file.h"
#include "server/run/render_thread.h"
#include "server/run/serial_events.h"
#include "sim/scene/quality.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(100);

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Turns the steps' heartbeats into progress with a time left, about ten a second.
class ProgressMeter {
 public:
  /// `from`: simulated before this run, s.
  ProgressMeter(const Plan& plan, double from, RunEvents& events)
      : plan_(plan), first_fraction_(fraction_at(from)), events_(events) {}

  void heartbeat(const Progress& now) {
    if (now.frame == last_frame_ && Clock::now() - last_told_ < kProgressInterval) return;
    last_frame_ = now.frame;
    last_told_ = Clock::now();
    RunProgress told;
    told.frame = now.frame;
    told.frames = plan_.frames;
    told.time = now.time;
    told.time_step = now.time_step;
    told.step = now.step;
    told.fraction = fraction_at(now.time);
    if (plan_.scene.budget) told.budget_seconds = plan_.scene.budget->seconds;
    const double spent = seconds_since(start_);
    if (told.fraction > first_fraction_) {
      const double done = told.fraction - first_fraction_;
      told.eta_seconds = spent * (1 - told.fraction) / done;
      told.expected_seconds = spent / done;
      told.seconds_per_frame = spent / (done * std::max(1, plan_.frames - 1));
    }
    events_.progress(told);
    warn_of_the_budget(told);
  }

 private:
  [[nodiscard]] double fraction_at(double time) const {
    const double end = (plan_.frames - 1) / plan_.scene.frame_rate;
    return end > 0 ? std::clamp(time / end, 0.0, 1.0) : 1.0;
  }

  /// Once, when a tenth of the run has shown how fast it is.
  void warn_of_the_budget(const RunProgress& told) {
    const bool over = told.budget_seconds > 0 && told.expected_seconds > told.budget_seconds;
    if (warned_ || !over || told.fraction < 0.1) return;
    warned_ = true;
    char text[96];
    std::snprintf(text, sizeof text,
                  "warning: the run will take %.3g s at its speed so far, over its budget of %.3g s",
                  told.expected_seconds, told.budget_seconds);
    events_.log(text);
  }

  const Plan& plan_;
  const double first_fraction_;
  RunEvents& events_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_told_{};
  int last_frame_ = -1;
  bool warned_ = false;
};

/// Takes checkpoints of a simulation between its steps: by the clock, and so rarely that the steps wait for
/// them a tenth of the time at most.
class Checkpoints {
 public:
  Checkpoints(const RunSettings& settings, RenderThread& writer, RunEvents& events)
      : wanted_(!settings.checkpoints.empty()),
        interval_(settings.checkpoint_interval),
        writer_(writer),
        events_(events),
        next_(Clock::now() + interval_) {}

  void take_when_due(const Simulation& simulation, const Progress& now) {
    if (!wanted_ || Clock::now() < next_) return;
    constexpr int kRarity = 10;
    const Clock::time_point start = Clock::now();
    take(simulation, now.step, now.time, false);
    next_ = Clock::now() + std::max<Clock::duration>(interval_, kRarity * (Clock::now() - start));
  }

  /// `spare`: see RenderThread::push().
  void take_at_end(const Simulation& simulation, bool spare) {
    if (wanted_) take(simulation, simulation.report().steps, simulation.report().simulated_time, spare);
  }

 private:
  /// Where drawing has failed it is dropped, for the next frame is, too, and finish() says why.
  void take(const Simulation& simulation, std::uint64_t step, double time, bool spare) {
    try {
      static_cast<void>(writer_.push(Checkpoint{step, time, simulation.save(), spare}));
    } catch (const std::bad_alloc&) {  // twice the state's memory was too much; the run itself goes on
      events_.log("warning: there is too little memory for a checkpoint at step " + std::to_string(step));
    }
  }

  const bool wanted_;
  const std::chrono::milliseconds interval_;
  RenderThread& writer_;
  RunEvents& events_;
  Clock::time_point next_;
};

/// A simulation at its start, or where the first usable checkpoint leaves it.
std::unique_ptr<Simulation> start_or_resume(const Plan& plan, const RunSettings& settings,
                                            std::unique_ptr<Simulation> fresh, RunEvents& events) {
  for (const std::filesystem::path& file : settings.resume_from) {
    try {
      fresh->restore(read_checkpoint(file));
      events.log("goes on from the checkpoint " + file.filename().string() + ", frame " +
                 std::to_string(fresh->report().frames.back().frame));
      return fresh;
    } catch (const CheckpointError& error) {
      events.log("warning: the checkpoint " + file.filename().string() + " is of no use: " + error.what());
    } catch (const InputError& error) {
      events.log("warning: the checkpoint " + file.filename().string() + " is of no use: " + error.what());
      fresh = Simulation::create(plan, settings.threads);  // a restore may have stopped half-way
    }
  }
  if (!settings.resume_from.empty()) events.log("no checkpoint can be used: from the start");
  return fresh;
}

/// An automatic camera is framed by frame 0, also where that frame was drawn by another run.
Scene with_camera(Scene scene, const Simulation& at_start) {
  if (scene.look.camera.automatic)
    scene.look.camera = render::automatic_camera(scene.look, scene.output, at_start.frame());
  return scene;
}

/// Steps through the frames that are left and hands each to the render thread; the state to report.
std::string make_frames(const Plan& plan, Simulation& simulation, int first, const RunSettings& settings,
                        RenderThread& renderer, RunEvents& events, const std::atomic<Stop>& stop) {
  ProgressMeter meter(plan, simulation.report().simulated_time, events);
  Checkpoints checkpoints(settings, renderer, events);
  const auto heartbeat = [&](const Progress& now) {
    meter.heartbeat(now);
    checkpoints.take_when_due(simulation, now);
    return stop.load() == Stop::kNo;
  };
  for (int index = first; index < plan.frames; ++index) {
    const bool whole = simulation.step_to_frame(index, heartbeat);
    if (stop.load() == Stop::kNow) return "cancelled";
    // The checkpoint that ends a pause has this frame behind it, so the frame comes first.
    if (whole && !renderer.push(simulation.frame())) return "cancelled";
    if (stop.load() == Stop::kNo || (whole && index + 1 == plan.frames)) continue;
    checkpoints.take_at_end(simulation, false);
    return "paused";
  }
  checkpoints.take_at_end(simulation, true);  // from which the run can be made longer
  return "succeeded";
}

/// What the budget asked for and was promised, beside what the run took.
BudgetReport kept(const Plan& plan, double seconds) {
  const BudgetChoice& choice = *plan.choices.budget;
  BudgetReport report;
  report.seconds = plan.scene.budget->seconds;
  report.error = plan.scene.budget->error;
  report.quality = quality_point(plan.scene.solver, choice.quality).name;
  report.predicted_seconds = choice.seconds;
  report.predicted_error = choice.error;
  report.actual_seconds = seconds;
  return report;
}

}  // namespace

Report run(const Plan& plan, const RunSettings& settings, RunEvents& events, const std::atomic<Stop>& stop) {
  SerialEvents serial(events);
  RunSettings with_threads = settings;
  with_threads.threads = thread_count(settings.threads);
  const int threads = with_threads.threads;
  const Clock::time_point start = Clock::now();
  std::unique_ptr<Simulation> simulation = Simulation::create(plan, threads);
  const Scene drawn = settings.resume_from.empty() ? plan.scene : with_camera(plan.scene, *simulation);
  RenderThread renderer(drawn, plan.scene, with_threads, serial);
  serial.log("drawing with " + renderer.backend());
  for (const std::string& warning : plan.warnings) serial.log("warning: " + warning);
  simulation = start_or_resume(plan, with_threads, std::move(simulation), serial);
  // The report has the frames so far; that of a simulation at its start has frame 0, which is not drawn yet.
  const bool at_start = simulation->report().steps == 0;
  const int first = at_start ? 0 : simulation->report().frames.back().frame + 1;

  std::string state;
  std::string error;
  try {
    state = make_frames(plan, *simulation, first, with_threads, renderer, serial, stop);
  } catch (const SimulationError& failure) {
    state = "failed";
    error = failure.what();
  }
  renderer.finish(state != "cancelled");

  Report report = simulation->report();
  report.state = state;
  report.error = error;
  report.render_backend = renderer.backend();
  report.render_seconds = renderer.seconds();
  report.threads = threads;
  // Of a run that went on from a checkpoint nobody knows how long it took before.
  if (plan.scene.budget && plan.choices.budget && at_start) report.budget = kept(plan, seconds_since(start));
  if (!report.probes.empty()) write_whole(settings.probes, probes_csv(report.probes));
  write_whole(settings.report, to_json(report));
  return report;
}

std::string frame_file_name(int index, const std::string& ending) {
  char number[32];
  std::snprintf(number, sizeof number, "%05d.", index);
  return number + ending;
}

int thread_count(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace lather::server
