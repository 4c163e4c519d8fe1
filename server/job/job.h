#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lather::server {

enum class JobState { kQueued, kRunning, kPausing, kPaused, kCancelling, kCancelled, kSucceeded, kFailed };

[[nodiscard]] const char* to_string(JobState state);
/// Throws std::invalid_argument for a word that names no state.
[[nodiscard]] JobState job_state_from_string(std::string_view word);

/// True for the transitions that exist; all others are refused. queued -> running -> succeeded or failed;
/// running -> queued when the server stops or an attempt is lost; queued -> paused, running -> pausing ->
/// paused -> queued; cancelled at once from queued and paused, by way of cancelling from running and pausing;
/// and from the ends back to queued: failed or cancelled by a retry, succeeded when it is made longer.
[[nodiscard]] bool can_move(JobState from, JobState to);

/// Nothing happens any more unless a user asks for more: succeeded, failed, cancelled.
[[nodiscard]] bool has_ended(JobState state);

/// An attempt is at work: its agent holds a lease.
[[nodiscard]] bool is_at_work(JobState state);

/// An attempt stands while its runner may publish frames and checkpoints.
[[nodiscard]] bool attempt_stands(JobState state);

/// Losses of attempts in a row, without a new checkpoint between them, that end a job.
inline constexpr int kMostLosses = 3;

/// Where a job that is at work goes when its attempt has died or its agent fell silent, and this is its
/// `losses`th loss in a row: what was asked of it happens; else it is queued again, or fails.
[[nodiscard]] JobState after_loss(JobState state, int losses);

/// The error of a job that failed so; `last` says how the last attempt ended.
[[nodiscard]] std::string lost_too_often(const std::string& last);

struct JobProgress {
  int frame = 0;        ///< the frame being worked towards
  int frames = 0;       ///< pictures in all
  double time = 0;      ///< simulated, s
  double fraction = 0;  ///< of the simulated duration, 0 … 1
  std::uint64_t step = 0;
  double seconds_per_frame = 0;  ///< wall clock
  double eta_seconds = -1;       ///< wall clock until the end; negative: not known yet
};

/// What the store keeps of a job beside its documents (scene, plan).
struct Job {
  std::string id;  ///< 22 characters of [A-Za-z0-9_-]
  std::string name;
  JobState state = JobState::kQueued;
  int priority = 0;          ///< higher first
  std::int64_t created = 0;  ///< ms since 1970
  std::int64_t started = 0;  ///< of the last attempt; 0: never
  std::int64_t ended = 0;    ///< 0: not yet
  int attempt = 0;           ///< 0: none yet
  int losses = 0;            ///< of attempts in a row, since the last checkpoint
  std::string error;         ///< why it failed, in words that help
  std::uint64_t points = 0;
  double frame_rate = 0;        ///< of the scene, 1/s
  double checkpoint_time = -1;  ///< simulated, s, of the last checkpoint; negative: there is none
  JobProgress progress;
  std::string idempotency_key;  ///< "": none
  std::string request_digest;   ///< of the submission that the key stands for
};

/// One finished picture.
struct FrameRow {
  int index = 0;
  std::string sha256;
  std::uint64_t size = 0;  ///< bytes
  int attempt = 0;         ///< the attempt whose directory holds the file
};

/// One checkpoint that a next attempt may go on from.
struct CheckpointRow {
  int attempt = 0;  ///< the attempt whose directory holds the file
  std::uint64_t step = 0;
  double time = 0;         ///< simulated, s
  std::uint64_t size = 0;  ///< bytes
};

/// Checkpoints that are kept of a job.
inline constexpr std::size_t kKeptCheckpoints = 2;

inline constexpr std::size_t kJobIdLength = 22;
[[nodiscard]] std::string new_job_id();
[[nodiscard]] bool is_job_id(std::string_view text);

/// ms since 1970.
[[nodiscard]] std::int64_t now_ms();
/// RFC 3339 in UTC with milliseconds.
[[nodiscard]] std::string timestamp(std::int64_t ms);

}  // namespace lather::server
