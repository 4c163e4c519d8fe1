#include "server/command/service.h"

#include <pthread.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdint>

#include "sim/error.h"

namespace lather::server {
namespace {

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

}  // namespace

sigset_t block_stop_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t stop;
  ::sigemptyset(&stop);
  ::sigaddset(&stop, SIGINT);
  ::sigaddset(&stop, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
  return stop;
}

void wait_for_stop(const sigset_t& stop) {
  int signal = 0;
  ::sigwait(&stop, &signal);
  spdlog::info("{}: stopping; running jobs write a checkpoint and go back into the queue",
               signal == SIGINT ? "SIGINT" : "SIGTERM");
}

void log_to_stderr() {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("lather"));
  spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
}

std::unique_ptr<Store> open_shared_store(const AgentOptions& options, std::chrono::milliseconds patience) {
  const bool is_postgres =
      options.store.rfind("postgresql://", 0) == 0 || options.store.rfind("postgres://", 0) == 0;
  if (!is_postgres)  // its value is not shown: it may hold a password
    throw InputError(
        {{"--store", "", "postgresql://[USER@]HOST[:PORT]/DATABASE",
          "the store shared with workers is a PostgreSQL database, named by --store or LATHER_STORE"}});
  PostgresSettings settings;
  settings.lease_term = milliseconds(options.lease_seconds);
  settings.patience = patience;
  return open_postgres_store(options.store, settings);
}

AgentSettings agent_settings(const AgentOptions& options, const std::filesystem::path& artifacts) {
  AgentSettings settings;
  settings.data = artifacts;
  settings.workers = options.workers;
  settings.threads = options.threads;
  settings.render_backend = options.render_backend;
  settings.memory_limit = options.runner_memory;
  settings.silence = milliseconds(options.lease_seconds);
  settings.checkpoint_interval = milliseconds(options.checkpoint_seconds);
  return settings;
}

}  // namespace lather::server
