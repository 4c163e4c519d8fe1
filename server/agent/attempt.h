#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "server/agent/counters.h"
#include "server/artifacts/owned_fd.h"
#include "server/job/job.h"
#include "server/store/store.h"

namespace lather::server {

struct RunnerOrder;
struct RunnerOutcome;

struct AgentSettings {
  std::filesystem::path data;  ///< absolute
  int workers = 1;             ///< jobs at a time
  int threads = 0;             ///< of each job; 0: the cores shared evenly among the workers
  std::string render_backend = "auto";
  std::uint64_t memory_limit = 0;                 ///< of a runner's address space, bytes; 0: none
  std::chrono::milliseconds cancel_grace{1000};   ///< from the cancel message to SIGKILL
  std::chrono::milliseconds pause_grace{60'000};  ///< from the pause message: a checkpoint may be gigabytes
  std::chrono::milliseconds silence{15'000};      ///< of a runner that is taken as frozen, and ended
  std::chrono::milliseconds checkpoint_interval{60'000};
  std::size_t most_log_bytes = std::size_t{1} << 20;
};

/// One attempt at a job: a runner started, heard and seen to its end; the job is left in the state that
/// follows.
class Attempt {
 public:
  Attempt(Store& store, const Job& job, const AgentSettings& settings, Counters& counters);

  /// Works on it until it has ended, or the lease is lost. Never throws for what a runner does; throws when
  /// the store fails.
  void run();

  /// After a throw: the attempt is over, its job goes where after_loss() says. Throws as run().
  void lose(const std::string& why);

  // From any thread:
  void look();     ///< the job has been moved in the store: look there now, and not half a second later
  void abandon();  ///< the server stops: the runner pauses, the job is queued again

  [[nodiscard]] const std::string& id() const { return job_.id; }

 private:
  void wake() const;
  [[nodiscard]] RunnerOrder make_order() const;
  [[nodiscard]] std::vector<std::string> particles_of(const std::string& source) const;
  void settle(const RunnerOutcome& outcome);
  [[nodiscard]] std::optional<JobState> first_possible(std::initializer_list<JobState> ways,
                                                       const std::string& error);
  void say_lost() const;
  void count(const RunnerOutcome& outcome, JobState next);
  void tidy_after_success();

  Store& store_;
  const Job job_;
  const AgentSettings& settings_;
  Counters& counters_;
  const std::filesystem::path directory_;  // of the job
  OwnedFd wake_;                           // an eventfd
  std::atomic<bool> abandoned_{false};
};

}  // namespace lather::server
