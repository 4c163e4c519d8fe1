#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "server/agent/agent.h"
#include "server/agent/recovery.h"
#include "server/artifacts/layout.h"
#include "server/artifacts/lock_file.h"
#include "server/command/service.h"
#include "server/http/api.h"
#include "server/http/listener.h"
#include "server/store/store.h"
#include "sim/error.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

constexpr auto kDatabasePatience = std::chrono::seconds(3);  // for an HTTP client waits, too

bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.compare(0, 4, "127.") == 0;
}

void require_reachable_on_purpose(const ServeOptions& options) {
  if (is_loopback(options.host) || options.allow_remote) return;
  throw InputError(
      {{"--host", options.host, "127.0.0.1, ::1 or localhost; others with --allow-remote",
        "whoever can reach this address could run jobs, for there are no API keys yet: put a proxy with "
        "authentication before it and say --allow-remote"}});
}

/// A thousand waiting connections need as many descriptors.
void raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// The installed or checked-out example scenes, where there are any.
fs::path find_scenes(const ServeOptions& options) {
  if (!options.scenes.empty()) return fs::absolute(options.scenes);
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* beside : {"../share/lather/scenes", "../../scenes"}) {
    fs::path scenes = (program / beside).lexically_normal();
    if (fs::is_directory(scenes, ignored)) return scenes;
  }
  return {};
}

std::unique_ptr<Store> open_own_store(const fs::path& data) {
  std::unique_ptr<Store> store = open_sqlite_store(data / "lather.db");
  const Recovery done = recover(*store, data);
  if (done.jobs + done.files + done.directories > 0)
    spdlog::info("after the last end: {} jobs put back, {} unfinished files and {} directories removed",
                 done.jobs, done.files, done.directories);
  return store;
}

/// No file is swept under a shared store: workers may be writing there.
std::unique_ptr<Store> open_store(const AgentOptions& options, const fs::path& data) {
  return options.store.empty() ? open_own_store(data) : open_shared_store(options, kDatabasePatience);
}

/// Files of jobs that the SQLite store does not know are swept, so it and they stay together.
fs::path artifacts_directory(const ServeOptions& options, const fs::path& data) {
  if (options.agent.artifacts.empty()) return data;
  if (options.agent.store.empty())
    throw InputError({{"--artifacts", options.agent.artifacts.string(), "only with --store postgresql://…",
                       "without --store all of it lies in the data directory: name that with --data"}});
  return fs::absolute(options.agent.artifacts);
}

ListenerSettings listener_settings(const ServeOptions& options) {
  ListenerSettings settings;
  settings.hosts = options.allow_host;
  settings.parking.head_deadline =
      std::chrono::milliseconds(static_cast<long>(1000 * options.request_seconds));
  settings.parking.body_deadline = 3 * settings.parking.head_deadline;
  return settings;
}

ApiSettings api_settings(const ServeOptions& options, const fs::path& artifacts) {
  ApiSettings settings;
  settings.data = artifacts;
  settings.scenes = find_scenes(options);
  settings.limits = options.limits;
  settings.ffmpeg = options.ffmpeg;
  return settings;
}

}  // namespace

int serve_command(const ServeOptions& options) {
  require_reachable_on_purpose(options);
  const sigset_t stop_signals = block_stop_signals();
  raise_descriptor_limit();
  log_to_stderr();
  const fs::path data = fs::absolute(options.data);
  const fs::path artifacts = artifacts_directory(options, data);
  fs::create_directories(data);
  fs::create_directories(jobs_directory(artifacts));
  const LockFile lock(data);
  const std::unique_ptr<Store> store = open_store(options.agent, data);

  Counters counters;
  Agent agent(*store, agent_settings(options.agent, artifacts), counters);
  Api api(*store, agent, counters, api_settings(options, artifacts));
  Listener listener(listener_settings(options),
                    [&api](const HttpRequest& request) { return api.handle(request); });
  const int port = listener.start(options.host, options.port);
  const bool v6 = options.host.find(':') != std::string::npos;
  std::printf("listening on http://%s:%d\n", v6 ? ('[' + options.host + ']').c_str() : options.host.c_str(),
              port);
  std::fflush(stdout);

  wait_for_stop(stop_signals);
  listener.stop();
  agent.stop();
  spdlog::info("stopped");
  return 0;
}

}  // namespace lather::server
