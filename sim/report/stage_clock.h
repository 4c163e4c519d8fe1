#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "sim/math/parallel.h"
#include "sim/plan/stages.h"

namespace lather {

/// Seconds per stage, summed over threads. Stages that share a loop are told apart block by block. Of a stage
/// that is not within a loop, the time between its loops is serial: all other threads wait.
class StageClock {
 public:
  explicit StageClock(int threads) : per_thread_(static_cast<std::size_t>(threads)) {}

  /// Runs body() and books its time to `stage` on the calling thread.
  template <class Body>
  void time(Stage stage, const Body& body) {
    const double in_loops = ParallelTime::seconds();
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    Slot& slot = per_thread_[static_cast<std::size_t>(thread_index())];
    slot.seconds[static_cast<std::size_t>(stage)] += took.count();
    if (!ParallelTime::inside())
      slot.serial[static_cast<std::size_t>(stage)] += took.count() - (ParallelTime::seconds() - in_loops);
  }

  [[nodiscard]] double seconds(Stage stage) const { return sum(&Slot::seconds, stage); }
  [[nodiscard]] double serial_seconds(Stage stage) const { return sum(&Slot::serial, stage); }

 private:
  struct alignas(128) Slot {
    std::array<double, kStageCount> seconds{};
    std::array<double, kStageCount> serial{};
  };

  [[nodiscard]] double sum(std::array<double, kStageCount> Slot::*kind, Stage stage) const {
    double sum = 0;
    for (const Slot& s : per_thread_) sum += (s.*kind)[static_cast<std::size_t>(stage)];
    return sum;
  }

  std::vector<Slot> per_thread_;
};

}  // namespace lather
