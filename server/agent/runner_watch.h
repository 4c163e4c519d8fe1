#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "server/agent/attempt_log.h"
#include "server/agent/counters.h"
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
  double seconds = 0;     ///< from its start to its end
  bool lost = false;      ///< the lease is another's now, or nobody's: there is nothing left to write
  bool given_up = false;  ///< it did not stop in time when it was asked to, and was ended by force
  bool frozen = false;    ///< it gave no sign of life, and was ended by force
};

/// What may be asked of a running attempt from outside; `wake` is an eventfd that is written when the store
/// or `abandoned` is to be looked at.
struct AttemptSignals {
  int wake = -1;
  const std::atomic<bool>& abandoned;
  std::chrono::milliseconds cancel_grace;
  std::chrono::milliseconds pause_grace;
  std::chrono::milliseconds silence;
};

/// Hears one runner to its end: publishes its frames, checkpoints and progress in the store, keeps its log
/// and its lease, passes on what is asked of the job there (cancel, pause), pauses it when it is abandoned,
/// and ends it by force when that has no effect in time, when it is frozen, or when the lease is lost.
class RunnerWatch {
 public:
  /// `directory` is the job's.
  RunnerWatch(Store& store, const Job& job, const std::filesystem::path& directory, AttemptLog& log,
              const AttemptSignals& signals, Counters& counters);
  [[nodiscard]] RunnerOutcome watch(const RunnerOrder& order);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool wait_for_news();  ///< false once the runner has ended
  void keep_lease();
  void ask(std::string_view line, bool& asked, std::chrono::milliseconds grace);
  void end_when_frozen();
  void store_progress();
  void hear_events();
  void hear_log();
  void on(const RunProgress& progress);
  void on(const FrameFile& frame);
  void on(const CheckpointFile& checkpoint);
  void on(const RunnerAlive&) {}
  void on(const RunnerResult& result);

  Store& store_;
  const Job& job_;
  const std::filesystem::path& directory_;
  AttemptLog& log_;
  const AttemptSignals& signals_;
  Counters& counters_;
  RunnerProcess runner_;
  LineSocket socket_;
  RunnerOutcome outcome_;
  bool cancel_asked_ = false;
  bool pause_asked_ = false;
  bool socket_open_ = true;
  bool log_open_ = true;
  Clock::time_point kill_at_ = Clock::time_point::max();
  Clock::time_point next_heartbeat_ = Clock::now();
  std::optional<std::uint64_t> counted_step_;  // point-steps are counted up to here
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_heard_ = Clock::now();
  Clock::time_point last_stored_{};
};

}  // namespace lather::server
