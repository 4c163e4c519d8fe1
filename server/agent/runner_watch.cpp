#include "server/agent/runner_watch.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <variant>

#include "server/agent/recovery.h"

namespace lather::server {
namespace {

constexpr std::size_t kLongestEvent = std::size_t{1} << 20;
// Each write to the store is a sync of the disk: progress is stored at this pace only, frames at once.
constexpr auto kStoreInterval = std::chrono::milliseconds(400);
// Also the longest time until a cancel that another process has written is seen.
constexpr auto kHeartbeatInterval = std::chrono::milliseconds(500);

}  // namespace

RunnerWatch::RunnerWatch(Store& store, const Job& job, const std::filesystem::path& directory,
                         AttemptLog& log, const AttemptSignals& signals, Counters& counters)
    : store_(store),
      job_(job),
      directory_(directory),
      log_(log),
      signals_(signals),
      counters_(counters),
      socket_(runner_.socket(), kLongestEvent) {}

RunnerOutcome RunnerWatch::watch(const RunnerOrder& order) {
  socket_.send(to_line(order));
  while (wait_for_news()) {
    keep_lease();
    hear_events();
    hear_log();
    end_when_frozen();
  }
  outcome_.end = runner_.wait();
  hear_events();
  hear_log();
  if (outcome_.last.frames > 0 && !outcome_.lost) store_progress();
  outcome_.log_tail = log_.tail();
  outcome_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return outcome_;
}

bool RunnerWatch::wait_for_news() {
  pollfd watched[] = {{runner_.ended(), POLLIN, 0},
                      {signals_.wake, POLLIN, 0},
                      {socket_open_ ? runner_.socket() : -1, POLLIN, 0},
                      {log_open_ ? runner_.log() : -1, POLLIN, 0}};
  const Clock::time_point next = std::min(kill_at_, next_heartbeat_);
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next - Clock::now());
  const int timeout_ms = static_cast<int>(std::max<std::int64_t>(0, left.count() + 1));
  if (::poll(watched, std::size(watched), timeout_ms) < 0 && errno != EINTR) runner_.kill();
  if (watched[1].revents & POLLIN) {
    std::uint64_t count = 0;
    while (::read(signals_.wake, &count, sizeof count) < 0 && errno == EINTR) {
    }
    next_heartbeat_ = Clock::now();
  }
  if (Clock::now() >= kill_at_) {
    outcome_.given_up = true;
    runner_.kill();
    kill_at_ = Clock::time_point::max();
  }
  return !(watched[0].revents & POLLIN);
}

void RunnerWatch::keep_lease() {
  if (outcome_.lost || Clock::now() < next_heartbeat_) return;
  const std::optional<JobState> state = store_.heartbeat(job_.id, job_.attempt);
  next_heartbeat_ = Clock::now() + kHeartbeatInterval;
  outcome_.lost = !state;
  if (outcome_.lost) runner_.kill();
  if (state == JobState::kCancelling) ask(kCancelLine, cancel_asked_, signals_.cancel_grace);
  if (state == JobState::kPausing || signals_.abandoned.load())
    ask(kPauseLine, pause_asked_, signals_.pause_grace);
}

void RunnerWatch::ask(std::string_view line, bool& asked, std::chrono::milliseconds grace) {
  if (asked) return;
  asked = true;
  socket_.send(line);
  kill_at_ = std::min(kill_at_, Clock::now() + grace);
}

void RunnerWatch::end_when_frozen() {
  if (outcome_.frozen || Clock::now() - last_heard_ < signals_.silence) return;
  outcome_.frozen = true;
  runner_.kill();
}

void RunnerWatch::hear_events() {
  LineSocket::Read read = LineSocket::Read::kData;
  while (socket_open_ && read == LineSocket::Read::kData) {
    read = socket_.receive(false);
    if (read == LineSocket::Read::kData) last_heard_ = Clock::now();
    while (const std::optional<std::string> line = socket_.next_line()) {
      if (const std::optional<RunnerEvent> event = event_from_line(*line))
        std::visit([this](const auto& e) { on(e); }, *event);
    }
    if (read == LineSocket::Read::kEnd) socket_open_ = false;
  }
}

void RunnerWatch::hear_log() {
  char chunk[16384];
  while (log_open_) {
    const ssize_t got = ::read(runner_.log(), chunk, sizeof chunk);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got <= 0) log_open_ = false;
    if (got > 0) log_.append({chunk, static_cast<std::size_t>(got)});
  }
}

void RunnerWatch::on(const RunProgress& progress) {
  const bool last = progress.fraction >= 1;
  outcome_.last = progress;
  // The first word of an attempt may come far into a run that goes on from a checkpoint.
  if (counted_step_ && progress.step > *counted_step_)
    counters_.add("lather_point_steps_total",
                  static_cast<double>(job_.points) * static_cast<double>(progress.step - *counted_step_));
  counted_step_ = progress.step;
  if (!last && Clock::now() - last_stored_ < kStoreInterval) return;
  store_progress();
}

void RunnerWatch::store_progress() {
  last_stored_ = Clock::now();
  const RunProgress& progress = outcome_.last;
  JobProgress stored;
  stored.frame = progress.frame;
  stored.frames = progress.frames;
  stored.time = progress.time;
  stored.fraction = progress.fraction;
  stored.step = progress.step;
  stored.seconds_per_frame = progress.seconds_per_frame;
  stored.eta_seconds = progress.eta_seconds;
  store_.set_progress(job_.id, job_.attempt, stored);
}

void RunnerWatch::on(const FrameFile& frame) {
  if (frame.index < 0 || frame.index >= job_.progress.frames || frame.sha256.size() != 64) return;
  if (store_.publish(job_.id, job_.attempt, {frame.index, frame.sha256, frame.size, job_.attempt}))
    counters_.add("lather_frames_total");
}

void RunnerWatch::on(const CheckpointFile& checkpoint) {
  if (!store_.add_checkpoint(job_.id, {job_.attempt, checkpoint.step, checkpoint.time, checkpoint.size}))
    return;
  counters_.add("lather_checkpoints_total");
  for (const CheckpointRow& old : store_.drop_checkpoints(job_.id, kKeptCheckpoints))
    remove_file(checkpoint_path(directory_, old));
}

void RunnerWatch::on(const RunnerResult& result) {
  outcome_.result = result;
}

}  // namespace lather::server
