#include "server/agent/agent.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace lather::server {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(500);
constexpr auto kGiveBackPause = std::chrono::seconds(1);

}  // namespace

Agent::Agent(Store& store, AgentSettings settings, Counters& counters)
    : store_(store), settings_(std::move(settings)), counters_(counters) {
  for (const char* name : {"lather_frames_total", "lather_checkpoints_total", "lather_point_steps_total",
                           "lather_attempt_seconds_count", "lather_attempt_seconds_sum"})
    counters_.add(name, 0);  // there from the start
  for (int i = 0; i < settings_.workers; ++i) workers_.emplace_back([this] { work(); });
  if (workers_.empty()) workers_.emplace_back([this] { reclaim(); });
}

Agent::~Agent() {
  stop();
}

void Agent::wake() {
  const std::lock_guard lock(mutex_);
  ++news_;
  changed_.notify_all();
}

bool Agent::cancel(const std::string& id) {
  // A move is refused when the job has gone on since it was looked at: then it is looked at again.
  while (true) {
    const std::optional<Job> job = store_.find(id);
    if (!job || has_ended(job->state)) return false;
    if (job->state == JobState::kCancelling) return true;
    if (store_.move(id, is_at_work(job->state) ? JobState::kCancelling : JobState::kCancelled)) break;
  }
  look(id);
  return true;
}

bool Agent::pause(const std::string& id) {
  while (true) {  // as above
    const std::optional<Job> job = store_.find(id);
    if (!job || has_ended(job->state) || job->state == JobState::kCancelling) return false;
    if (job->state == JobState::kPausing || job->state == JobState::kPaused) return true;
    if (store_.move(id, is_at_work(job->state) ? JobState::kPausing : JobState::kPaused)) break;
  }
  look(id);
  return true;
}

void Agent::look(const std::string& id) {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Attempt>& attempt : running_)
    if (attempt->id() == id) attempt->look();
}

void Agent::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const std::shared_ptr<Attempt>& attempt : running_) attempt->abandon();
    changed_.notify_all();
  }
  for (std::thread& worker : workers_)
    if (worker.joinable()) worker.join();
}

void Agent::work() {
  while (const std::shared_ptr<Attempt> attempt = take()) {
    try {
      attempt->run();
    } catch (const std::exception& failure) {
      spdlog::error("job {}: {}", attempt->id(), failure.what());
      give_back(*attempt, failure.what());
    }
    drop(attempt);
  }
}

/// The store could not be read or written. The job would stay `running` there without anyone at work on it,
/// so it is tried until the store can be written again, or knows the attempt no more.
void Agent::give_back(Attempt& attempt, const std::string& why) {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    try {
      attempt.lose(why);
      return;
    } catch (const std::exception& failure) {
      spdlog::error("job {} cannot be given back: {}", attempt.id(), failure.what());
    }
    lock.lock();
    changed_.wait_for(lock, kGiveBackPause, [this] { return stopping_; });
  }
}

void Agent::reclaim() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    try {
      store_.reclaim();
    } catch (const std::exception& failure) {
      spdlog::error("cannot look for lost jobs: {}", failure.what());
    }
    lock.lock();
    changed_.wait_for(lock, kPollInterval, [this] { return stopping_; });
  }
}

std::shared_ptr<Attempt> Agent::take() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const unsigned seen = news_;
    lock.unlock();  // the store may take its time
    try {
      if (const std::optional<Job> job = store_.lease()) return start(*job);
    } catch (const std::exception& failure) {
      spdlog::error("cannot lease a job: {}", failure.what());
    }
    lock.lock();
    changed_.wait_for(lock, kPollInterval, [&] { return stopping_ || news_ != seen; });
  }
  return nullptr;
}

std::shared_ptr<Attempt> Agent::start(const Job& job) {
  auto attempt = std::make_shared<Attempt>(store_, job, settings_, counters_);
  const std::lock_guard lock(mutex_);
  running_.push_back(attempt);
  if (stopping_) attempt->abandon();
  return attempt;
}

void Agent::drop(const std::shared_ptr<Attempt>& attempt) {
  const std::lock_guard lock(mutex_);
  running_.erase(std::remove(running_.begin(), running_.end(), attempt), running_.end());
}

}  // namespace lather::server
