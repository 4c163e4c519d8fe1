#include "server/run/run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "server/artifacts/whole_file.h"
#include "server/run/render_thread.h"
#include "server/run/serial_events.h"
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
  ProgressMeter(const Plan& plan, RunEvents& events) : plan_(plan), events_(events) {}

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
    const double end = (plan_.frames - 1) / plan_.scene.frame_rate;
    told.fraction = end > 0 ? std::clamp(now.time / end, 0.0, 1.0) : 1.0;
    const double spent = seconds_since(start_);
    if (told.fraction > 0) {
      told.eta_seconds = spent * (1 - told.fraction) / told.fraction;
      told.seconds_per_frame = spent / (told.fraction * std::max(1, plan_.frames - 1));
    }
    events_.progress(told);
  }

 private:
  const Plan& plan_;
  RunEvents& events_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_told_{};
  int last_frame_ = -1;
};

/// Steps through all frames and hands each to the render thread; false when stopped before the end.
bool make_frames(const Plan& plan, Simulation& simulation, RenderThread& renderer, RunEvents& events,
                 const std::atomic<bool>& stop) {
  ProgressMeter meter(plan, events);
  const auto heartbeat = [&](const Progress& now) {
    meter.heartbeat(now);
    return !stop.load();
  };
  for (int index = 0; index < plan.frames; ++index) {
    if (!simulation.step_to_frame(index, heartbeat)) return false;
    if (stop.load() || !renderer.push(simulation.frame())) return false;
  }
  return true;
}

}  // namespace

Report run(const Plan& plan, const RunSettings& settings, RunEvents& events, const std::atomic<bool>& stop) {
  SerialEvents serial(events);
  RunSettings with_threads = settings;
  with_threads.threads = thread_count(settings.threads);
  const int threads = with_threads.threads;
  RenderThread renderer(plan.scene, scene_hash(plan.scene), with_threads, serial);
  serial.log("drawing with " + renderer.backend());
  for (const std::string& warning : plan.warnings) serial.log("warning: " + warning);

  const std::unique_ptr<Simulation> simulation = Simulation::create(plan, threads);
  std::string state;
  std::string error;
  try {
    state = make_frames(plan, *simulation, renderer, serial, stop) ? "succeeded" : "cancelled";
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
