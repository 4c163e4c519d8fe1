#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "server/agent/agent.h"
#include "server/artifacts/layout.h"
#include "server/command/service.h"
#include "sim/error.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

/// Made by the server. A worker that made it would draw into a directory that nobody reads.
void require_artifacts(const fs::path& artifacts) {
  if (fs::is_directory(jobs_directory(artifacts))) return;
  throw InputError(
      {{"--artifacts", artifacts.string(), "the artifacts directory of the server, seen from here",
        "there is no directory 'jobs' in it: start 'lather serve' on it first, and mount it on this "
        "machine if it lies on another"}});
}

}  // namespace

int worker_command(const AgentOptions& options) {
  const sigset_t stop_signals = block_stop_signals();
  log_to_stderr();
  const fs::path artifacts = fs::absolute(options.artifacts);
  require_artifacts(artifacts);
  // A restart of the database must not end attempts of hours: it is waited for as long as the leases last.
  const std::chrono::milliseconds patience(static_cast<long>(1000 * options.lease_seconds * 2 / 3));
  const std::unique_ptr<Store> store = open_shared_store(options, patience);
  Counters counters;  // a worker has no /metrics: those of the store are the server's
  Agent agent(*store, agent_settings(options, artifacts), counters);
  std::printf("working on %d jobs at a time\n", options.workers);
  std::fflush(stdout);

  wait_for_stop(stop_signals);
  agent.stop();
  spdlog::info("stopped");
  return 0;
}

}  // namespace lather::server
