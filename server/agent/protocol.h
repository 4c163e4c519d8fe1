#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/run/run.h"

/// What agent and runner say to each other over the inherited socket pair: one JSON object a line.
namespace lather::server {

/// Down, first and once.
struct RunnerOrder {
  std::string plan;       ///< JSON
  std::string directory;  ///< of the attempt
  int threads = 0;
  std::string render_backend = "auto";
  std::uint64_t memory_limit = 0;  ///< of the address space, bytes; 0: none
  std::string particles;           ///< directory of kept ones to draw again; "": the plan is simulated
};

/// Down, at most once, after the order.
inline constexpr std::string_view kCancelLine = "{\"cancel\":true}\n";

/// Up, last and once.
struct RunnerResult {
  std::string state;  ///< "succeeded", "failed", "cancelled"
  std::string error;
};

using RunnerEvent = std::variant<RunProgress, FrameFile, RunnerResult>;

/// With the newline at its end.
[[nodiscard]] std::string to_line(const RunnerOrder& order);
[[nodiscard]] std::string to_line(const RunnerEvent& event);

/// Throws std::runtime_error for a line that is none.
[[nodiscard]] RunnerOrder order_from_line(std::string_view line);
/// None for a line that is no event: the agent does not believe all that a broken runner sends.
[[nodiscard]] std::optional<RunnerEvent> event_from_line(std::string_view line);

}  // namespace lather::server
