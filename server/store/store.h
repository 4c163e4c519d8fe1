#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/job/job.h"

/// Jobs and frames, kept. All methods may be called from any thread; an answered write is on the disk.
/// Throws std::runtime_error when the database fails.
///
/// Where a job may go from where it is, is said in one place, can_move() and after_loss() in
/// server/job/job.h; both stores ask there.
///
/// A job that is worked on is leased: its attempt number is the fence, for a write that names an older one is
/// refused. The PostgreSQL store serves agents on many machines, so a lease there runs out by the database's
/// clock unless its agent renews it, and another agent takes the job as its next attempt. The SQLite store is
/// opened by one process, which holds all leases for as long as it lives; they end with recover().
namespace lather::server {

struct Listing {
  std::optional<JobState> state;  ///< only these
  std::size_t limit = 50;
  std::string cursor;  ///< from the page before; "": the newest
};

struct JobPage {
  std::vector<Job> jobs;    ///< newest first
  std::string next_cursor;  ///< "": this is the last page
};

struct Submission {
  Job job;
  std::string scene;  ///< canonical JSON
  std::string plan;   ///< JSON
};

/// What changes when a finished job is made longer.
struct LongerRun {
  std::string scene;  ///< canonical JSON
  std::string plan;   ///< JSON
  int frames = 0;     ///< pictures in all
  std::uint64_t points = 0;
};

class Store {
 public:
  virtual ~Store() = default;

  /// Adds a queued job, unless one with the same idempotency key exists: then that one is returned and
  /// nothing is added.
  virtual std::optional<Job> add(const Submission& submission) = 0;

  [[nodiscard]] virtual std::optional<Job> find(const std::string& id) = 0;
  [[nodiscard]] virtual std::optional<std::string> plan(const std::string& id) = 0;
  [[nodiscard]] virtual std::optional<std::string> scene(const std::string& id) = 0;
  /// Throws std::invalid_argument for a cursor that was never given out.
  [[nodiscard]] virtual JobPage list(const Listing& listing) = 0;
  [[nodiscard]] virtual std::size_t count(JobState state) = 0;

  /// Takes the first queued job (highest priority, then oldest) into its next attempt. Calls reclaim() first.
  [[nodiscard]] virtual std::optional<Job> lease() = 0;

  /// Renews the lease of an attempt and says where its job is: running, pausing or cancelling. None when the
  /// attempt has lost the job; it must stop then, for nothing it writes is taken any longer.
  [[nodiscard]] virtual std::optional<JobState> heartbeat(const std::string& id, int attempt) = 0;

  /// Ends leases that have run out, each as after_loss() says. Says how many.
  virtual std::size_t reclaim() = 0;

  /// Moves a job along can_move(); false, and nothing changes, when there is no such job or no such
  /// transition from where it is. Sets `ended` for the last states and `error` for failed.
  virtual bool move(const std::string& id, JobState to, const std::string& error = {}) = 0;
  /// The same, only while `attempt` is the job's last one: for the agent that worked on it.
  virtual bool settle(const std::string& id, int attempt, JobState to, const std::string& error = {}) = 0;

  /// The attempt has died, as `why` says: its job goes where after_loss() says, which is answered. None when
  /// `attempt` is not the job's last one, or is not at work any more.
  virtual std::optional<JobState> lose(const std::string& id, int attempt, const std::string& why) = 0;

  /// Back into the queue from `from`, where the user has asked for it: losses and error are forgotten, frames
  /// and checkpoints stay. False when the job is not there, or no way leads from there.
  virtual bool requeue(const std::string& id, JobState from) = 0;
  /// The same for a job that has succeeded, which is to run on.
  virtual bool extend(const std::string& id, const LongerRun& longer) = 0;

  /// False when there is no such job, or it has ended.
  virtual bool set_priority(const std::string& id, int priority) = 0;

  /// Only while `attempt` stands; false otherwise.
  virtual bool set_progress(const std::string& id, int attempt, const JobProgress& progress) = 0;
  /// Adds a frame, or replaces an older attempt's. Only while `attempt` stands; false otherwise.
  virtual bool publish(const std::string& id, int attempt, const FrameRow& frame) = 0;

  /// By index, from `first` on.
  [[nodiscard]] virtual std::vector<FrameRow> frames(const std::string& id, int first) = 0;
  [[nodiscard]] std::vector<FrameRow> frames(const std::string& id) { return frames(id, 0); }
  [[nodiscard]] virtual std::optional<FrameRow> frame(const std::string& id, int index) = 0;
  [[nodiscard]] virtual std::size_t count_frames(const std::string& id) = 0;

  /// Adds a checkpoint and forgets losses. Only while `attempt` stands; false otherwise.
  virtual bool add_checkpoint(const std::string& id, const CheckpointRow& checkpoint) = 0;
  /// By attempt, then by step, the last one first.
  [[nodiscard]] virtual std::vector<CheckpointRow> checkpoints(const std::string& id) = 0;
  /// Drops all but the `keep` last ones, and says which, so that their files can be removed.
  virtual std::vector<CheckpointRow> drop_checkpoints(const std::string& id, std::size_t keep) = 0;

  /// Removes a job that has ended, with the rows of its frames and checkpoints; false when there is none or
  /// it has not ended.
  virtual bool remove(const std::string& id) = 0;

  /// Before the first agent of this store starts, after a crash: attempts that nobody holds any longer are
  /// lost. Says how many.
  virtual std::size_t recover() = 0;
};

/// Opens or creates the database. It must lie on a local disk and be opened by one process only: the server
/// holds its single connection (SQLite 3.40 can lose data with more than one connection in WAL mode).
[[nodiscard]] std::unique_ptr<Store> open_sqlite_store(const std::filesystem::path& file);

struct PostgresSettings {
  std::chrono::milliseconds lease_term{15'000};  ///< from a heartbeat to the loss of the job
  /// How long a call waits for a database that has gone away, before it throws.
  std::chrono::milliseconds patience{3'000};
};

/// Opens the database at `uri` (postgresql://…; what it leaves out is taken from libpq's variables and
/// password file) and creates the tables where there are none. Any number of processes may do so at once.
/// Error messages do not repeat the URI, for it may hold a password.
[[nodiscard]] std::unique_ptr<Store> open_postgres_store(const std::string& uri,
                                                         const PostgresSettings& settings = {});

/// A cursor as it is given out. Throws std::invalid_argument for a text that is none.
[[nodiscard]] std::int64_t sequence_of_cursor(const std::string& cursor);

}  // namespace lather::server
