#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

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
  std::uint64_t memory_limit = 0;                ///< of a runner's address space, bytes; 0: none
  std::chrono::milliseconds cancel_grace{1000};  ///< from the cancel message to SIGKILL
  std::size_t most_log_bytes = std::size_t{1} << 20;
};

/// One attempt at a job: a runner started, heard and seen to its end; the job is left in the state that
/// follows.
class Attempt {
 public:
  Attempt(Store& store, const Job& job, const AgentSettings& settings);

  /// Works on it until it has ended, or the lease is lost. Never throws for what a runner does; throws when
  /// the store fails.
  void run();

  // From any thread:
  void
  cancel();  ///< the user wants no more; the job is `cancelling` in the store (read there anyway, but later)
  void abandon();  ///< the server stops; the job is queued again

  [[nodiscard]] const std::string& id() const { return job_.id; }

 private:
  void wake() const;
  [[nodiscard]] RunnerOrder make_order() const;
  void settle(const RunnerOutcome& outcome);
  void say_lost() const;
  void remove_older_attempts() const;

  Store& store_;
  const Job job_;
  const AgentSettings& settings_;
  const std::filesystem::path directory_;  // of the job
  OwnedFd wake_;                           // an eventfd
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> abandoned_{false};
};

}  // namespace lather::server
