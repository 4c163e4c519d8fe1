#include "server/agent/agent.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace lather::server {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(500);

}  // namespace

Agent::Agent(Store& store, AgentSettings settings) : store_(store), settings_(std::move(settings)) {
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
    const bool queued = job->state == JobState::kQueued;
    if (store_.move(id, queued ? JobState::kCancelled : JobState::kCancelling)) break;
  }
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Attempt>& attempt : running_)
    if (attempt->id() == id) attempt->cancel();
  return true;
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
      // The store cannot be written: the job stays `running` there until its lease ends.
      spdlog::error("job {}: {}", attempt->id(), failure.what());
    }
    drop(attempt);
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
  auto attempt = std::make_shared<Attempt>(store_, job, settings_);
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
