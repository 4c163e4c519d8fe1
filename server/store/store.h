#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/job/job.h"

/// Jobs and frames, kept. All methods may be called from any thread; an answered write is on the disk.
/// Throws std::runtime_error when the database fails.
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

  /// Takes the first queued job (highest priority, then oldest) into its next attempt.
  [[nodiscard]] virtual std::optional<Job> lease() = 0;

  /// Moves a job along can_move(); false, and nothing changes, when there is no such job or no such
  /// transition from where it is. Sets `ended` for the last states and `error` for failed.
  virtual bool move(const std::string& id, JobState to, const std::string& error = {}) = 0;

  /// Only while `attempt` stands; false otherwise.
  virtual bool set_progress(const std::string& id, int attempt, const JobProgress& progress) = 0;
  /// Adds a frame, or replaces an older attempt's. Only while `attempt` stands; false otherwise.
  virtual bool publish(const std::string& id, int attempt, const FrameRow& frame) = 0;

  [[nodiscard]] virtual std::vector<FrameRow> frames(const std::string& id) = 0;  ///< by index
  [[nodiscard]] virtual std::optional<FrameRow> frame(const std::string& id, int index) = 0;
  [[nodiscard]] virtual std::size_t count_frames(const std::string& id) = 0;

  /// Removes a job that has ended, with its frames' rows; false when there is none or it has not ended.
  virtual bool remove(const std::string& id) = 0;

  /// After a crash: running jobs are queued again, cancelling ones are cancelled. Says how many.
  virtual std::size_t recover() = 0;
};

/// Opens or creates the database. It must lie on a local disk and be opened by one process only: the server
/// holds its single connection (SQLite 3.40 can lose data with more than one connection in WAL mode).
[[nodiscard]] std::unique_ptr<Store> open_sqlite_store(const std::filesystem::path& file);

}  // namespace lather::server
