#include "server/command/run_events.h"

#include <csignal>
#include <cstdio>
#include <string>

#include "server/agent/protocol.h"
#include "server/command/progress_bar.h"

namespace lather::server {
namespace {

std::atomic<Stop> interrupted{Stop::kNo};

/// Whether the time that a budget allows will do, at the speed so far.
std::string budget_text(const RunProgress& progress) {
  if (progress.budget_seconds <= 0 || progress.expected_seconds < 0) return "";
  const bool holds = progress.expected_seconds <= progress.budget_seconds;
  return ", " + duration_text(progress.expected_seconds) + " of " + duration_text(progress.budget_seconds) +
         (holds ? "" : ": over the budget");
}

class EventsForPeople final : public RunEvents {
 public:
  void progress(const RunProgress& progress) override {
    char text[96];
    std::snprintf(text, sizeof text, "frame %d of %d, step %llu", progress.frame, progress.frames - 1,
                  static_cast<unsigned long long>(progress.step));
    bar_.show(progress.fraction, progress.eta_seconds, text + budget_text(progress));
  }
  void frame(const FrameFile&) override {}
  void checkpoint(const CheckpointFile&) override {}
  void log(const std::string& line) override { bar_.line(line); }

 private:
  ProgressBar bar_;
};

/// One JSON object a line on stdout, the same ones that a server's runner sends.
class EventsAsJson final : public RunEvents {
 public:
  void progress(const RunProgress& progress) override { print(progress); }
  void frame(const FrameFile& frame) override { print(frame); }
  void checkpoint(const CheckpointFile& checkpoint) override { print(checkpoint); }
  void log(const std::string& line) override { std::fprintf(stderr, "%s\n", line.c_str()); }
  static void print(const RunnerEvent& event) {
    std::fputs(to_line(event).c_str(), stdout);
    std::fflush(stdout);
  }
};

}  // namespace

const std::atomic<Stop>& heed_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted.store(Stop::kNow); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends it at once
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

Report with_events(bool json, const std::function<Report(RunEvents&)>& work) {
  if (json) {
    EventsAsJson events;
    Report report = work(events);
    EventsAsJson::print(
        RunnerResult{report.state, report.error, report.state == "failed" ? "simulation" : ""});
    return report;
  }
  EventsForPeople events;
  return work(events);
}

}  // namespace lather::server
