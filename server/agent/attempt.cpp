#include "server/agent/attempt.h"

#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "server/agent/recovery.h"
#include "server/agent/runner_watch.h"
#include "server/artifacts/layout.h"
#include "server/artifacts/whole_file.h"
#include "server/job/drawn_from.h"

namespace lather::server {
namespace {

struct NothingToDraw : std::runtime_error {
  NothingToDraw() : std::runtime_error("the job whose particles were to be drawn again is gone") {}
};

/// Why a runner that gave no result ended, for the user.
std::string describe_crash(const RunnerOutcome& outcome) {
  std::string text = "the runner ";
  if (outcome.frozen) {
    text += "gave no sign of life any more and was ended";
  } else if (outcome.end.signal != 0) {
    text += "was ended by " + signal_name(outcome.end.signal) + " (signal " +
            std::to_string(outcome.end.signal) + ")";
  } else {
    text += "ended without a result, exit code " + std::to_string(outcome.end.exit_code);
  }
  text += " at frame " + std::to_string(outcome.last.frame) + ", step " + std::to_string(outcome.last.step);
  if (outcome.end.signal == SIGKILL && !outcome.frozen)
    text += ". If nobody ended it on purpose, the machine ran out of memory: choose a larger spacing";
  if (!outcome.log_tail.empty()) text += ". Its last lines:\n" + outcome.log_tail;
  return text;
}

int threads_of_one(const AgentSettings& settings) {
  if (settings.threads > 0) return settings.threads;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return std::max(1, cores / std::max(1, settings.workers));
}

}  // namespace

Attempt::Attempt(Store& store, const Job& job, const AgentSettings& settings, Counters& counters)
    : store_(store),
      job_(job),
      settings_(settings),
      counters_(counters),
      directory_(job_directory(settings.data, job.id)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!wake_) throw std::system_error(errno, std::generic_category(), "cannot make an eventfd");
}

void Attempt::run() {
  RunnerOutcome outcome;
  try {
    const RunnerOrder order = make_order();
    make_directories(order.directory);
    AttemptLog log(std::filesystem::path(order.directory) / kLogName, settings_.most_log_bytes);
    const AttemptSignals signals = {wake_.get(), abandoned_, settings_.cancel_grace, settings_.pause_grace,
                                    settings_.silence};
    RunnerWatch watch(store_, job_, directory_, log, signals, counters_);
    spdlog::info("job {} attempt {} started", job_.id, job_.attempt);
    outcome = watch.watch(order);
  } catch (const std::system_error& failure) {
    outcome.result =
        RunnerResult{"failed", std::string("the runner could not be started: ") + failure.what(), "files"};
  } catch (const NothingToDraw& failure) {
    outcome.result = RunnerResult{"failed", failure.what(), "input"};
  }
  settle(outcome);
  sweep_attempt(store_, directory_, job_.id, job_.attempt);
}

void Attempt::lose(const std::string& why) {
  if (store_.lose(job_.id, job_.attempt, why)) counters_.add("lather_attempts_total{outcome=\"lost\"}");
  sweep_attempt(store_, directory_, job_.id, job_.attempt);
}

void Attempt::look() {
  wake();
}

void Attempt::abandon() {
  abandoned_.store(true);
  wake();
}

void Attempt::wake() const {
  const std::uint64_t one = 1;
  while (::write(wake_.get(), &one, sizeof one) < 0 && errno == EINTR) {
  }
}

RunnerOrder Attempt::make_order() const {
  RunnerOrder order;
  order.plan = store_.plan(job_.id).value_or("");
  order.directory = (directory_ / attempt_path(job_.attempt)).string();
  order.threads = threads_of_one(settings_);
  order.render_backend = settings_.render_backend;
  order.memory_limit = settings_.memory_limit;
  order.checkpoint_seconds = std::chrono::duration<double>(settings_.checkpoint_interval).count();
  for (const CheckpointRow& row : store_.checkpoints(job_.id))
    order.resume_from.push_back(checkpoint_path(directory_, row).string());
  if (const std::optional<std::string> source = drawn_from(order.plan))
    order.particles = particles_of(*source);
  return order;
}

/// Where the particles of a job lie: its frames may come from several attempts, the last of which is right.
std::vector<std::string> Attempt::particles_of(const std::string& source) const {
  std::set<int, std::greater<>> attempts;
  for (const FrameRow& frame : store_.frames(source)) attempts.insert(frame.attempt);
  if (attempts.empty()) throw NothingToDraw();
  std::vector<std::string> directories;
  for (const int attempt : attempts)
    directories.push_back(
        (job_directory(settings_.data, source) / attempt_path(attempt) / "particles").string());
  return directories;
}

void Attempt::settle(const RunnerOutcome& outcome) {
  using S = JobState;
  if (outcome.lost) return say_lost();
  const std::string state = outcome.result ? outcome.result->state : "";
  std::string error = outcome.result ? outcome.result->error : describe_crash(outcome);
  std::optional<S> next;
  if (state == "succeeded")
    next = first_possible({S::kSucceeded, S::kCancelled}, "");
  else if (state == "failed")
    next = first_possible({S::kFailed, S::kCancelled}, error);
  else if (outcome.result || outcome.given_up)  // it stopped, or was made to, because it was asked to
    next = first_possible({S::kPaused, S::kQueued, S::kCancelled}, "");
  else
    next = store_.lose(job_.id, job_.attempt, error);
  if (!next) return say_lost();
  spdlog::info("job {} attempt {} {}{}{}", job_.id, job_.attempt, to_string(*next), error.empty() ? "" : ": ",
               error);
  count(outcome, *next);
  if (*next == S::kSucceeded) tidy_after_success();
}

void Attempt::count(const RunnerOutcome& outcome, JobState next) {
  const bool died = !outcome.result && !outcome.given_up;
  counters_.add(std::string("lather_attempts_total{outcome=\"") + (died ? "lost" : to_string(next)) + "\"}");
  counters_.add("lather_attempt_seconds_count");
  counters_.add("lather_attempt_seconds_sum", outcome.seconds);
  if (next != JobState::kFailed) return;
  counters_.add("lather_failures_total{cause=\"" + (died ? std::string("runner") : outcome.result->cause) +
                "\"}");
}

/// Someone may have moved the job since it was last looked at: the store refuses the ways that do not start
/// where it is.
std::optional<JobState> Attempt::first_possible(std::initializer_list<JobState> ways,
                                                const std::string& error) {
  for (const JobState way : ways)
    if (store_.settle(job_.id, job_.attempt, way, error)) return way;
  return std::nullopt;
}

void Attempt::say_lost() const {
  spdlog::warn("job {} attempt {} has lost its lease: what it made is not taken", job_.id, job_.attempt);
}

void Attempt::tidy_after_success() {
  // One checkpoint, from which the job can be made longer; older attempts' files only as far as rows name
  // them.
  for (const CheckpointRow& row : store_.drop_checkpoints(job_.id, 1))
    remove_file(checkpoint_path(directory_, row));
  for (int attempt = 1; attempt < job_.attempt; ++attempt)
    sweep_attempt(store_, directory_, job_.id, attempt);
}

}  // namespace lather::server
