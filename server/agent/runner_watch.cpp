#include "server/agent/runner_watch.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <variant>

namespace lather::server {
namespace {

constexpr std::size_t kLongestEvent = std::size_t{1} << 20;
// Each write to the store is a sync of the disk: progress is stored at this pace only, frames at once.
constexpr auto kStoreInterval = std::chrono::milliseconds(400);
// Also the longest time until a cancel that another process has written is seen.
constexpr auto kHeartbeatInterval = std::chrono::milliseconds(500);

}  // namespace

RunnerWatch::RunnerWatch(Store& store, const Job& job, AttemptLog& log, const AttemptSignals& signals)
    : store_(store), job_(job), log_(log), signals_(signals), socket_(runner_.socket(), kLongestEvent) {}

RunnerOutcome RunnerWatch::watch(const RunnerOrder& order) {
  socket_.send(to_line(order));
  while (wait_for_news()) {
    keep_lease();
    heed_signals();
    hear_events();
    hear_log();
  }
  outcome_.end = runner_.wait();
  hear_events();
  hear_log();
  if (outcome_.last.frames > 0 && !outcome_.lost) store_progress();
  outcome_.log_tail = log_.tail();
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
  }
  if (Clock::now() >= kill_at_) {
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
  if (state == JobState::kCancelling) begin_cancel();
}

void RunnerWatch::heed_signals() {
  if (signals_.abandoned.load()) runner_.kill();
  if (signals_.cancelled.load()) begin_cancel();
}

void RunnerWatch::begin_cancel() {
  if (cancel_sent_) return;
  cancel_sent_ = true;
  socket_.send(kCancelLine);
  kill_at_ = Clock::now() + signals_.cancel_grace;
}

void RunnerWatch::hear_events() {
  LineSocket::Read read = LineSocket::Read::kData;
  while (socket_open_ && read == LineSocket::Read::kData) {
    read = socket_.receive(false);
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
  store_.publish(job_.id, job_.attempt, {frame.index, frame.sha256, frame.size, job_.attempt});
}

void RunnerWatch::on(const RunnerResult& result) {
  outcome_.result = result;
}

}  // namespace lather::server
