#include "server/agent/agent.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

namespace lather::server {

Agent::Agent(Store& store, AgentSettings settings) : store_(store), settings_(std::move(settings)) {
  for (int i = 0; i < settings_.workers; ++i) workers_.emplace_back([this] { work(); });
}

Agent::~Agent() {
  stop();
}

void Agent::wake() {
  const std::lock_guard lock(mutex_);
  changed_.notify_one();
}

bool Agent::cancel(const std::string& id) {
  // A lease and its place in running_ change together under the lock, so a running job is always found there.
  const std::lock_guard lock(mutex_);
  const std::optional<Job> job = store_.find(id);
  if (!job || has_ended(job->state)) return false;
  if (job->state == JobState::kQueued) return store_.move(id, JobState::kCancelled);
  if (job->state == JobState::kRunning && !store_.move(id, JobState::kCancelling)) return false;
  const auto attempt = running_.find(id);
  if (attempt != running_.end()) attempt->second->cancel();
  return true;
}

void Agent::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [id, attempt] : running_) attempt->abandon();
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
      // The store cannot be written: the job stays `running` there and is queued again at the next start.
      spdlog::error("job {}: {}", attempt->id(), failure.what());
    }
    drop(attempt);
  }
}

std::shared_ptr<Attempt> Agent::take() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    try {
      if (const std::optional<Job> job = store_.lease())
        return running_.emplace(job->id, std::make_shared<Attempt>(store_, *job, settings_)).first->second;
    } catch (const std::exception& failure) {
      spdlog::error("cannot lease a job: {}", failure.what());
    }
    changed_.wait(lock);
  }
  return nullptr;
}

void Agent::drop(const std::shared_ptr<Attempt>& attempt) {
  const std::lock_guard lock(mutex_);
  running_.erase(attempt->id());
}

}  // namespace lather::server
