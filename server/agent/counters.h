#pragma once

#include <map>
#include <mutex>
#include <string>

namespace lather::server {

/// What this process has done since its start, for /metrics. A counter is named as Prometheus writes it, e.g.
/// lather_attempts_total{outcome="lost"}, and only grows. From any thread.
class Counters {
 public:
  void add(const std::string& name, double amount = 1) {
    const std::lock_guard lock(mutex_);
    values_[name] += amount;
  }
  [[nodiscard]] std::map<std::string, double> values() const {
    const std::lock_guard lock(mutex_);
    return values_;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, double> values_;
};

}  // namespace lather::server
