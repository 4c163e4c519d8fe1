#include "server/agent/runner.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "server/agent/line_socket.h"
#include "server/agent/protocol.h"
#include "server/artifacts/layout.h"
#include "server/run/redraw.h"

namespace lather::server {
namespace {

constexpr std::size_t kLongestOrder = std::size_t{64} << 20;

/// A runner that breaks must not fill the disk with core files, nor die of a full quota without a word.
void limit_process(std::uint64_t memory) {
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  if (memory == 0) return;
  const rlimit address_space = {memory, memory};
  ::setrlimit(RLIMIT_AS, &address_space);
}

class EventsUp final : public RunEvents {
 public:
  explicit EventsUp(const LineSocket& up) : up_(up) {}
  void progress(const RunProgress& progress) override { send(progress); }
  void frame(const FrameFile& frame) override { send(frame); }
  void checkpoint(const CheckpointFile& checkpoint) override { send(checkpoint); }
  void log(const std::string& line) override { std::fprintf(stderr, "%s\n", line.c_str()); }

  void send(const RunnerEvent& event) {
    const std::string line = to_line(event);
    const std::lock_guard lock(mutex_);  // the signs of life come from a thread of their own
    up_.send(line);
  }

 private:
  const LineSocket& up_;
  std::mutex mutex_;
};

std::optional<RunnerOrder> receive_order(LineSocket& down) {
  while (down.receive(true) == LineSocket::Read::kData)
    if (const std::optional<std::string> line = down.next_line()) return order_from_line(*line);
  return std::nullopt;
}

/// Waits for a word to stop; when the agent is gone there is no one to work for.
void heed_agent(LineSocket& down, std::atomic<Stop>& stop) {
  while (true) {
    while (const std::optional<std::string> line = down.next_line()) {
      const bool pause = *line + '\n' == kPauseLine;
      if (stop.load() != Stop::kNow) stop.store(pause ? Stop::kAfterCheckpoint : Stop::kNow);
    }
    if (down.receive(true) == LineSocket::Read::kEnd) ::_exit(0);
  }
}

/// A step may take minutes; a runner that is silent for much longer than this is frozen or lost.
void show_life(EventsUp& events) {
  while (true) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    events.send(RunnerAlive{});
  }
}

RunSettings settings_of(const RunnerOrder& order) {
  const std::filesystem::path directory = order.directory;
  RunSettings settings;
  settings.frames = directory / kFramesPath;
  settings.report = directory / kReportName;
  settings.probes = directory / kProbesName;
  settings.threads = order.threads;
  settings.render_backend = order.render_backend;
  const bool simulates = order.particles.empty();
  if (!simulates) return settings;
  settings.files = directory;
  settings.checkpoints = directory / kCheckpointsPath;
  settings.checkpoint_interval =
      std::chrono::milliseconds(static_cast<std::int64_t>(1000 * order.checkpoint_seconds));
  settings.resume_from.assign(order.resume_from.begin(), order.resume_from.end());
  return settings;
}

RunnerResult run_order(const RunnerOrder& order, RunEvents& events, const std::atomic<Stop>& stop) {
  try {
    const RunSettings settings = settings_of(order);
    const std::vector<std::filesystem::path> particles(order.particles.begin(), order.particles.end());
    const Report report = particles.empty() ? run(read_plan(order.plan), settings, events, stop)
                                            : redraw(read_plan_scene(order.plan), particles, FrameRange{},
                                                     settings, events, stop);
    return {report.state, report.error, report.state == "failed" ? "simulation" : ""};
  } catch (const std::bad_alloc&) {
    return {"failed", "out of memory: choose a larger spacing, fewer points per cell or a smaller picture",
            "memory"};
  } catch (const InputError& failure) {
    return {"failed", failure.what(), "input"};
  } catch (const std::system_error& failure) {
    return {"failed", failure.what(), "files"};
  } catch (const std::exception& failure) {
    return {"failed", failure.what(), "other"};
  }
}

}  // namespace

int runner_main(int fd) {
  LineSocket socket(fd, kLongestOrder);
  const std::optional<RunnerOrder> order = receive_order(socket);
  if (!order) {
    std::fprintf(stderr, "'lather runner' is started by a server, not by hand: use 'lather run'\n");
    return 2;
  }
  limit_process(order->memory_limit);
  std::atomic<Stop> stop{Stop::kNo};
  EventsUp events(socket);
  std::thread(heed_agent, std::ref(socket), std::ref(stop)).detach();
  std::thread(show_life, std::ref(events)).detach();
  const RunnerResult result = run_order(*order, events, stop);
  if (!result.error.empty()) events.log(result.error);
  events.send(result);
  ::_exit(0);  // the other threads still use what a return would destroy
}

}  // namespace lather::server
