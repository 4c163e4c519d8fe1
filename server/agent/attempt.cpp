#include "server/agent/attempt.h"

#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <system_error>
#include <thread>

#include "server/agent/runner_watch.h"
#include "server/artifacts/layout.h"
#include "server/job/drawn_from.h"

namespace lather::server {
namespace {

/// Why a runner that gave no result ended, for the user.
std::string describe_crash(const RunnerOutcome& outcome) {
  std::string text = "the runner ";
  if (outcome.end.signal != 0) {
    text += "was ended by " + signal_name(outcome.end.signal) + " (signal " +
            std::to_string(outcome.end.signal) + ")";
  } else {
    text += "ended without a result, exit code " + std::to_string(outcome.end.exit_code);
  }
  text += " at frame " + std::to_string(outcome.last.frame) + ", step " + std::to_string(outcome.last.step);
  if (outcome.end.signal == SIGKILL)
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

Attempt::Attempt(Store& store, const Job& job, const AgentSettings& settings)
    : store_(store),
      job_(job),
      settings_(settings),
      directory_(job_directory(settings.data, job.id)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!wake_) throw std::system_error(errno, std::generic_category(), "cannot make an eventfd");
}

void Attempt::run() {
  RunnerOutcome outcome;
  try {
    const RunnerOrder order = make_order();
    std::filesystem::create_directories(order.directory);
    AttemptLog log(std::filesystem::path(order.directory) / kLogName, settings_.most_log_bytes);
    const AttemptSignals signals = {wake_.get(), cancelled_, abandoned_, settings_.cancel_grace};
    RunnerWatch watch(store_, job_, log, signals);
    spdlog::info("job {} attempt {} started", job_.id, job_.attempt);
    outcome = watch.watch(order);
  } catch (const std::system_error& failure) {
    outcome.result =
        RunnerResult{"failed", std::string("the runner could not be started: ") + failure.what()};
  }
  settle(outcome);
}

void Attempt::cancel() {
  cancelled_.store(true);
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
  if (const std::optional<DrawnFrom> source = drawn_from(order.plan))
    order.particles =
        (job_directory(settings_.data, source->job) / attempt_path(source->attempt) / "particles").string();
  return order;
}

void Attempt::settle(const RunnerOutcome& outcome) {
  if (outcome.lost) return say_lost();
  // A cancel that came in between has moved the job to `cancelling`, from where it can only be cancelled; so
  // each line below tries its own way, and the store refuses the ones that do not start where the job is.
  const bool succeeded = outcome.result && outcome.result->state == "succeeded";
  const bool failed = outcome.result && outcome.result->state == "failed";
  JobState next = JobState::kFailed;
  std::string error;
  if (succeeded) next = JobState::kSucceeded;
  if (failed) error = outcome.result->error;
  if (!outcome.result) error = describe_crash(outcome);
  if (abandoned_.load() && !succeeded && !failed) next = JobState::kQueued;
  if (!store_.settle(job_.id, job_.attempt, next, error)) {
    next = JobState::kCancelled;
    error.clear();
    if (!store_.settle(job_.id, job_.attempt, next)) return say_lost();
  }
  spdlog::info("job {} attempt {} {}{}{}", job_.id, job_.attempt, to_string(next), error.empty() ? "" : ": ",
               error);
  if (next == JobState::kSucceeded) remove_older_attempts();
}

void Attempt::say_lost() const {
  spdlog::warn("job {} attempt {} has lost its lease: what it made is not taken", job_.id, job_.attempt);
}

void Attempt::remove_older_attempts() const {
  // Every frame has been published anew, so nothing points there any longer.
  std::error_code ignored;
  for (int attempt = 1; attempt < job_.attempt; ++attempt)
    std::filesystem::remove_all(directory_ / attempt_path(attempt), ignored);
}

}  // namespace lather::server
