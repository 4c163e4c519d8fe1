#include "server/job/drawn_from.h"

#include <nlohmann/json.hpp>

#include "server/job/job.h"

namespace lather::server {

std::optional<DrawnFrom> drawn_from(std::string_view plan) {
  const auto json = nlohmann::json::parse(plan, nullptr, false);
  if (!json.is_object() || !json.contains("drawn_from")) return std::nullopt;
  DrawnFrom source;
  json.at("drawn_from").at("job").get_to(source.job);
  json.at("drawn_from").at("attempt").get_to(source.attempt);
  return is_job_id(source.job) ? std::optional(source) : std::nullopt;
}

std::string with_drawn_from(std::string_view plan, const DrawnFrom& source) {
  auto json = nlohmann::ordered_json::parse(plan);
  json["drawn_from"] = {{"job", source.job}, {"attempt", source.attempt}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lather::server
