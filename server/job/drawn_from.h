#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lather::server {

/// Where the particles of a job lie that draws another one's again. Stands in its plan as "drawn_from".
struct DrawnFrom {
  std::string job;
  int attempt = 0;
};

/// None for the plan of a job that simulates.
[[nodiscard]] std::optional<DrawnFrom> drawn_from(std::string_view plan);

[[nodiscard]] std::string with_drawn_from(std::string_view plan, const DrawnFrom& source);

}  // namespace lather::server
