#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/run/run.h"

/// What agent and runner say to each other over the inherited socket pair: one JSON object a line.
namespace lather::server {

/// Down, first and once.
struct RunnerOrder {
  std::string plan;       ///< JSON
  std::string directory;  ///< of the attempt
  int threads = 0;
  std::string render_backend = "auto";
  std::uint64_t memory_limit = 0;        ///< of the address space, bytes; 0: none
  double checkpoint_seconds = 60;        ///< between two checkpoints; see RunSettings
  std::vector<std::string> resume_from;  ///< checkpoints to go on from, the best first
  std::vector<std::string>
      particles;  ///< directories of kept ones to draw again; none: the plan is simulated
};

/// Down, at most once each, after the order.
inline constexpr std::string_view kCancelLine = "{\"cancel\":true}\n";
inline constexpr std::string_view kPauseLine = "{\"pause\":true}\n";

/// Up, about once a second: the runner can still be reached.
struct RunnerAlive {};

/// Up, last and once.
struct RunnerResult {
  std::string state;  ///< "succeeded", "failed", "cancelled", "paused"
  std::string error;
  std::string cause;  ///< of a failure, for the counters: "simulation", "memory", "files", "input", "other"
};

using RunnerEvent = std::variant<RunProgress, FrameFile, CheckpointFile, RunnerAlive, RunnerResult>;

/// With the newline at its end.
[[nodiscard]] std::string to_line(const RunnerOrder& order);
[[nodiscard]] std::string to_line(const RunnerEvent& event);

/// Throws std::runtime_error for a line that is none.
[[nodiscard]] RunnerOrder order_from_line(std::string_view line);
/// None for a line that is no event: the agent does not believe all that a broken runner sends.
[[nodiscard]] std::optional<RunnerEvent> event_from_line(std::string_view line);

}  // namespace lather::server
