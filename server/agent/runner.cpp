#include "server/agent/runner.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <thread>

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
  void progress(const RunProgress& progress) override { up_.send(to_line(RunnerEvent(progress))); }
  void frame(const FrameFile& frame) override { up_.send(to_line(RunnerEvent(frame))); }
  void log(const std::string& line) override { std::fprintf(stderr, "%s\n", line.c_str()); }

 private:
  const LineSocket& up_;
};

std::optional<RunnerOrder> receive_order(LineSocket& down) {
  while (down.receive(true) == LineSocket::Read::kData)
    if (const std::optional<std::string> line = down.next_line()) return order_from_line(*line);
  return std::nullopt;
}

/// Waits for the cancel line; when the agent is gone there is no one to work for.
void heed_agent(LineSocket& down, std::atomic<bool>& stop) {
  while (true) {
    while (down.next_line()) stop.store(true);
    if (down.receive(true) == LineSocket::Read::kEnd) ::_exit(0);
  }
}

RunnerResult run_order(const RunnerOrder& order, RunEvents& events, const std::atomic<bool>& stop) {
  try {
    const std::filesystem::path directory = order.directory;
    RunSettings settings = {directory / kFramesPath, directory / kReportName, directory / kProbesName,
                            order.threads,           order.render_backend,    directory};
    const bool draw_only = !order.particles.empty();
    if (draw_only) settings.files.clear();
    const Report report =
        draw_only ? redraw(read_plan_scene(order.plan), order.particles, FrameRange{}, settings, events, stop)
                  : run(read_plan(order.plan), settings, events, stop);
    return {report.state, report.error};
  } catch (const std::bad_alloc&) {
    return {"failed", "out of memory: choose a larger spacing, fewer points per cell or a smaller picture"};
  } catch (const std::exception& failure) {
    return {"failed", failure.what()};
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
  std::atomic<bool> stop{false};
  std::thread(heed_agent, std::ref(socket), std::ref(stop)).detach();
  EventsUp events(socket);
  const RunnerResult result = run_order(*order, events, stop);
  if (!result.error.empty()) events.log(result.error);
  socket.send(to_line(RunnerEvent(result)));
  ::_exit(0);  // the listening thread still uses what a return would destroy
}

}  // namespace lather::server
