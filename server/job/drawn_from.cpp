#include "server/job/drawn_from.h"

#include <nlohmann/json.hpp>

#include "server/job/job.h"

namespace lather::server {

std::optional<std::string> drawn_from(std::string_view plan) {
  const auto json = nlohmann::json::parse(plan, nullptr, false);
  if (!json.is_object() || !json.contains("drawn_from")) return std::nullopt;
  const std::string job = json.at("drawn_from").at("job").get<std::string>();
  return is_job_id(job) ? std::optional(job) : std::nullopt;
}

std::string with_drawn_from(std::string_view plan, const std::string& job) {
  auto json = nlohmann::ordered_json::parse(plan);
  json["drawn_from"] = {{"job", job}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lather::server
