#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include "server/agent/protocol.h"
#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/progress_bar.h"
#include "server/command/scene_source.h"
#include "server/run/run.h"
#include "sim/plan/plan.h"

namespace lather::server {
namespace {

std::atomic<bool> interrupted{false};

void heed_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted.store(true); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends it at once
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

class EventsForPeople final : public RunEvents {
 public:
  void progress(const RunProgress& progress) override {
    char text[96];
    std::snprintf(text, sizeof text, "frame %d of %d, step %llu", progress.frame, progress.frames - 1,
                  static_cast<unsigned long long>(progress.step));
    bar_.show(progress.fraction, progress.eta_seconds, text);
  }
  void frame(const FrameFile&) override {}
  void log(const std::string& line) override { bar_.line(line); }

 private:
  ProgressBar bar_;
};

/// One JSON object a line on stdout, the same ones that a server's runner sends.
class EventsAsJson final : public RunEvents {
 public:
  void progress(const RunProgress& progress) override { print(progress); }
  void frame(const FrameFile& frame) override { print(frame); }
  void log(const std::string& line) override { std::fprintf(stderr, "%s\n", line.c_str()); }
  static void print(const RunnerEvent& event) {
    std::fputs(to_line(event).c_str(), stdout);
    std::fflush(stdout);
  }
};

Report run_with_events(const Plan& plan, const RunSettings& settings, bool json) {
  if (json) {
    EventsAsJson events;
    Report report = run(plan, settings, events, interrupted);
    EventsAsJson::print(RunnerResult{report.state, report.error});
    return report;
  }
  EventsForPeople events;
  return run(plan, settings, events, interrupted);
}

int conclude(const Report& report, const RunOptions& options) {
  if (report.state == "cancelled") {
    std::fprintf(stderr, "interrupted; the frames made so far are in %s\n", (options.out / "frames").c_str());
    return kExitInterrupted;
  }
  if (report.state != "succeeded") {
    std::fprintf(stderr, "%s\nthe frames made before it are in %s\n", report.error.c_str(),
                 (options.out / "frames").c_str());
    return kExitSimulation;
  }
  if (!options.json)
    std::printf("%zu frames in %s\nreport in %s\n", report.frames.size(), (options.out / "frames").c_str(),
                (options.out / "report.json").c_str());
  if (!options.json && !report.probes.empty())
    std::printf("probes in %s\n", (options.out / "probes.csv").c_str());
  return 0;
}

}  // namespace

int run_command(const RunOptions& options) {
  const Plan plan = make_plan(read_scene(options.scene));
  heed_interrupts();
  std::filesystem::create_directories(options.out);
  write_whole(options.out / "plan.json", to_json(plan));
  const RunSettings settings = {options.out / "frames", options.out / "report.json",
                                options.out / "probes.csv", options.threads, options.render_backend};
  return conclude(run_with_events(plan, settings, options.json), options);
}

}  // namespace lather::server
