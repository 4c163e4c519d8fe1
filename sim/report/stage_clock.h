#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "sim/math/parallel.h"
#include "sim/plan/stages.h"

namespace lather {

/// Seconds per stage, summed over threads. Stages that share a loop are told apart block by block.
class StageClock {
 public:
  explicit StageClock(int threads) : per_thread_(static_cast<std::size_t>(threads)) {}

  /// Runs body() and books its time to `stage` on the calling thread.
  template <class Body>
  void time(Stage stage, const Body& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    per_thread_[static_cast<std::size_t>(thread_index())].seconds[static_cast<std::size_t>(stage)] +=
        took.count();
  }

  [[nodiscard]] double seconds(Stage stage) const {
    double sum = 0;
    for (const Slot& s : per_thread_) sum += s.seconds[static_cast<std::size_t>(stage)];
    return sum;
  }

 private:
  struct alignas(128) Slot {
    std::array<double, kStageCount> seconds{};
  };
  std::vector<Slot> per_thread_;
};

}  // namespace lather
