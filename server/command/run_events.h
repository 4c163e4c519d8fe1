#pragma once

#include <atomic>
#include <functional>

#include "server/run/run.h"

/// What commands that run in the foreground share.
namespace lather::server {

/// Set by the first SIGINT or SIGTERM from now on; the second one ends the program.
[[nodiscard]] const std::atomic<Stop>& heed_interrupts();

/// Calls work(events), which tell people on stderr how far it is, or programs on stdout: one JSON object a
/// line.
[[nodiscard]] Report with_events(bool json, const std::function<Report(RunEvents&)>& work);

}  // namespace lather::server
