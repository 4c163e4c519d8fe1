#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include "server/agent/attempt.h"
#include "server/command/commands.h"
#include "server/store/store.h"

/// What the programs that stay up (`serve`, `worker`) share.
namespace lather::server {

/// SIGINT and SIGTERM, blocked in all threads that are started after this, taken by wait_for_stop() alone.
[[nodiscard]] sigset_t block_stop_signals();
void wait_for_stop(const sigset_t& stop);

void log_to_stderr();

/// `patience`: how long a call waits for a database that has gone away. Throws InputError for a URI that is
/// not PostgreSQL's, std::runtime_error when it cannot be opened.
[[nodiscard]] std::unique_ptr<Store> open_shared_store(const AgentOptions& options,
                                                       std::chrono::milliseconds patience);

[[nodiscard]] AgentSettings agent_settings(const AgentOptions& options,
                                           const std::filesystem::path& artifacts);

}  // namespace lather::server
