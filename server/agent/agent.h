#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/agent/attempt.h"
#include "server/store/store.h"

namespace lather::server {

/// Leases queued jobs and works on them, `workers` at a time, until stopped. Asks the store every half
/// second, for other processes may have added or cancelled jobs; wake() and cancel() only save that wait.
/// Without workers it still sees to it that the jobs of lost agents are queued again.
class Agent {
 public:
  Agent(Store& store, AgentSettings settings, Counters& counters);
  ~Agent();  ///< stops
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  void wake();  ///< there may be a queued job

  /// Asks for a job's end; it is over within two seconds. False when it has ended before, or there is none.
  bool cancel(const std::string& id);

  /// Asks a job to rest: a queued one does at once, one at work when its checkpoint is written, which frees
  /// its worker. True also when it rests already; false when it is cancelling or has ended, or there is none.
  bool pause(const std::string& id);

  /// Has all runners write a checkpoint and end, queues their jobs again, and waits for that.
  void stop();

 private:
  void work();
  void give_back(Attempt& attempt, const std::string& why);
  void look(const std::string& id);
  void reclaim();
  [[nodiscard]] std::shared_ptr<Attempt> take();  // waits for a job; null once stopping
  [[nodiscard]] std::shared_ptr<Attempt> start(const Job& job);
  void drop(const std::shared_ptr<Attempt>& attempt);

  Store& store_;
  const AgentSettings settings_;
  Counters& counters_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;  // guarded by mutex_, as are the next two
  unsigned news_ = 0;      // counts wake()
  std::vector<std::shared_ptr<Attempt>> running_;
  std::vector<std::thread> workers_;
};

}  // namespace lather::server
