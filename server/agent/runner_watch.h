#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "server/agent/attempt_log.h"
#include "server/agent/line_socket.h"
#include "server/agent/protocol.h"
#include "server/agent/runner_process.h"
#include "server/job/job.h"
#include "server/store/store.h"

namespace lather::server {

/// What became of a runner.
struct RunnerOutcome {
  std::optional<RunnerResult> result;  ///< none: it ended without one
  RunnerProcess::End end;
  RunProgress last;  ///< what it was at
  std::string log_tail;
  bool lost = false;  ///< the lease is another's now, or nobody's: there is nothing left to write
};

/// What may be asked of a running attempt from outside; `wake` is an eventfd that is written after a change.
struct AttemptSignals {
  int wake = -1;
  const std::atomic<bool>& cancelled;
  const std::atomic<bool>& abandoned;
  std::chrono::milliseconds cancel_grace;
};

/// Hears one runner to its end: publishes its frames and progress in the store, keeps its log and its lease,
/// passes a cancel on (from this process, or read from the store) and ends it by force when that has no
/// effect in time, or when the lease is lost.
class RunnerWatch {
 public:
  RunnerWatch(Store& store, const Job& job, AttemptLog& log, const AttemptSignals& signals);
  [[nodiscard]] RunnerOutcome watch(const RunnerOrder& order);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool wait_for_news();  ///< false once the runner has ended
  void keep_lease();
  void heed_signals();
  void begin_cancel();
  void store_progress();
  void hear_events();
  void hear_log();
  void on(const RunProgress& progress);
  void on(const FrameFile& frame);
  void on(const RunnerResult& result);

  Store& store_;
  const Job& job_;
  AttemptLog& log_;
  const AttemptSignals& signals_;
  RunnerProcess runner_;
  LineSocket socket_;
  RunnerOutcome outcome_;
  bool cancel_sent_ = false;
  bool socket_open_ = true;
  bool log_open_ = true;
  Clock::time_point kill_at_ = Clock::time_point::max();
  Clock::time_point next_heartbeat_ = Clock::now();
  Clock::time_point last_stored_{};
};

}  // namespace lather::server
