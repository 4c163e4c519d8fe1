#include "server/agent/protocol.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace lather::server {
namespace {

using Json = nlohmann::json;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json json_of(const RunProgress& p) {
  return {{"event", "progress"},
          {"frame", p.frame},
          {"frames", p.frames},
          {"time", p.time},
          {"time_step", p.time_step},
          {"fraction", p.fraction},
          {"step", p.step},
          {"seconds_per_frame", p.seconds_per_frame},
          {"eta_seconds", p.eta_seconds},
          {"budget_seconds", p.budget_seconds},
          {"expected_seconds", p.expected_seconds}};
}

Json json_of(const FrameFile& f) {
  return {{"event", "frame"}, {"index", f.index}, {"file", f.file}, {"sha256", f.sha256}, {"size", f.size}};
}

Json json_of(const CheckpointFile& c) {
  return {{"event", "checkpoint"}, {"step", c.step}, {"time", c.time}, {"size", c.size}};
}

Json json_of(const RunnerAlive&) {
  return {{"event", "alive"}};
}

Json json_of(const RunnerResult& r) {
  return {{"event", "result"}, {"state", r.state}, {"error", r.error}, {"cause", r.cause}};
}

RunProgress progress_of(const Json& json) {
  RunProgress p;
  json.at("frame").get_to(p.frame);
  json.at("frames").get_to(p.frames);
  json.at("time").get_to(p.time);
  json.at("time_step").get_to(p.time_step);
  json.at("fraction").get_to(p.fraction);
  json.at("step").get_to(p.step);
  json.at("seconds_per_frame").get_to(p.seconds_per_frame);
  json.at("eta_seconds").get_to(p.eta_seconds);
  json.at("budget_seconds").get_to(p.budget_seconds);
  json.at("expected_seconds").get_to(p.expected_seconds);
  return p;
}

FrameFile frame_of(const Json& json) {
  FrameFile f;
  json.at("index").get_to(f.index);
  json.at("file").get_to(f.file);
  json.at("sha256").get_to(f.sha256);
  json.at("size").get_to(f.size);
  return f;
}

CheckpointFile checkpoint_of(const Json& json) {
  CheckpointFile c;
  json.at("step").get_to(c.step);
  json.at("time").get_to(c.time);
  json.at("size").get_to(c.size);
  return c;
}

RunnerResult result_of(const Json& json) {
  return {json.at("state").get<std::string>(), json.at("error").get<std::string>(),
          json.at("cause").get<std::string>()};
}

}  // namespace

std::string to_line(const RunnerOrder& order) {
  return line_of({{"plan", order.plan},
                  {"directory", order.directory},
                  {"threads", order.threads},
                  {"render_backend", order.render_backend},
                  {"memory_limit", order.memory_limit},
                  {"checkpoint_seconds", order.checkpoint_seconds},
                  {"resume_from", order.resume_from},
                  {"particles", order.particles}});
}

std::string to_line(const RunnerEvent& event) {
  return std::visit([](const auto& e) { return line_of(json_of(e)); }, event);
}

RunnerOrder order_from_line(std::string_view line) {
  const Json json = Json::parse(line);
  RunnerOrder order;
  json.at("plan").get_to(order.plan);
  json.at("directory").get_to(order.directory);
  json.at("threads").get_to(order.threads);
  json.at("render_backend").get_to(order.render_backend);
  json.at("memory_limit").get_to(order.memory_limit);
  json.at("checkpoint_seconds").get_to(order.checkpoint_seconds);
  json.at("resume_from").get_to(order.resume_from);
  json.at("particles").get_to(order.particles);
  return order;
}

std::optional<RunnerEvent> event_from_line(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    const std::string kind = json.at("event").get<std::string>();
    if (kind == "progress") return progress_of(json);
    if (kind == "frame") return frame_of(json);
    if (kind == "checkpoint") return checkpoint_of(json);
    if (kind == "alive") return RunnerAlive{};
    if (kind == "result") return result_of(json);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace lather::server
