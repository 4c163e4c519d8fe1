#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lather::server {

/// The job whose kept particles a job draws again: in the plan of that one as "drawn_from". None for the plan
/// of a job that simulates.
[[nodiscard]] std::optional<std::string> drawn_from(std::string_view plan);

[[nodiscard]] std::string with_drawn_from(std::string_view plan, const std::string& job);

}  // namespace lather::server
