#include <sys/statvfs.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "server/http/api.h"
#include "server/http/job_json.h"
#include "server/http/problem.h"
#include "sim/scene/value.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

constexpr std::array kStates = {JobState::kQueued,    JobState::kRunning,    JobState::kPausing,
                                JobState::kPaused,    JobState::kCancelling, JobState::kCancelled,
                                JobState::kSucceeded, JobState::kFailed};

struct Family {
  const char* name;
  const char* type;
  const char* help;
  const char* samples;  ///< how the names of its counters begin
};

/// Of counters; those of this process's own runners.
constexpr Family kFamilies[] = {
    {"lather_frames_total", "counter", "Frames published.", "lather_frames_total"},
    {"lather_checkpoints_total", "counter", "Checkpoints recorded.", "lather_checkpoints_total"},
    {"lather_point_steps_total", "counter", "Points times steps simulated.", "lather_point_steps_total"},
    {"lather_attempts_total", "counter", "Attempts that ended, by where their job went.",
     "lather_attempts_total{"},
    {"lather_failures_total", "counter", "Jobs that failed, by cause.", "lather_failures_total{"},
    {"lather_attempt_seconds", "summary", "How long attempts took.", "lather_attempt_seconds_"},
};

void begin(std::string& text, const char* name, const char* type, const char* help) {
  text += std::string("# HELP ") + name + ' ' + help + "\n# TYPE " + name + ' ' + type + '\n';
}

void sample(std::string& text, const std::string& name, double value) {
  char number[40];
  std::snprintf(number, sizeof number, " %.17g\n", value);
  text += name + number;
}

/// Bytes that may still be written below the directory; none when nobody knows.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& directory) {
  struct statvfs disk {};
  if (::statvfs(directory.c_str(), &disk) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
}

}  // namespace

HttpResponse Api::get_events(const HttpRequest& request, const std::string& id) {
  const Job job = need_job(id);
  const std::string last_id = request.header("last-event-id");
  const int first = frame_of_event_id(last_id);
  HttpResponse response;
  response.content_type = "text/event-stream";
  response.headers = {{"Cache-Control", "no-store"}, {"X-Accel-Buffering", "no"}};
  if (request.method == "HEAD") return response;
  // A browser would ask again for ever; 204 tells it that it has heard all.
  if (!last_id.empty() && has_ended(job.state) && store_.frames(id, first).empty()) {
    response.status = 204;
    return response;
  }
  std::shared_ptr<void> place = events_.take_place();
  if (!place) return busy_response("too many clients listen to events");
  response.take_over = [this, id, first, place = std::move(place)](OwnedFd connection, std::string head) {
    events_.add(std::move(connection), std::move(head), id, first, place);
  };
  return response;
}

HttpResponse Api::health() {
  const auto count = [this](JobState state) { return static_cast<std::int64_t>(store_.count(state)); };
  return json_response(200, write_json(Object{{"status", "ok"},
                                              {"version", version()},
                                              {"queued", count(JobState::kQueued)},
                                              {"running", count(JobState::kRunning)}}));
}

HttpResponse Api::readiness() {
  std::string store = "ok";
  try {
    static_cast<void>(store_.count(JobState::kQueued));
  } catch (const std::exception&) {  // its words may name what strangers need not know
    store = "does not answer";
  }
  const std::optional<std::uint64_t> room = free_bytes(settings_.data);
  const std::string disk = !room ? "cannot be read" : *room < settings_.least_disk ? "is full" : "ok";
  const bool ready = store == "ok" && disk == "ok";
  return json_response(ready ? 200 : 503,
                       write_json(Object{{"ready", ready}, {"store", store}, {"disk", disk}}));
}

HttpResponse Api::metrics() {
  std::string text;
  begin(text, "lather_build_info", "gauge", "The version that runs.");
  sample(text, std::string("lather_build_info{version=\"") + version() + "\"}", 1);
  begin(text, "lather_jobs", "gauge", "Jobs in the store, by state.");
  for (const JobState state : kStates)
    sample(text, std::string("lather_jobs{state=\"") + to_string(state) + "\"}",
           static_cast<double>(store_.count(state)));
  if (const std::optional<std::uint64_t> room = free_bytes(settings_.data)) {
    begin(text, "lather_disk_free_bytes", "gauge", "Room where the files of jobs lie.");
    sample(text, "lather_disk_free_bytes", static_cast<double>(*room));
  }
  const std::map<std::string, double> values = counters_.values();
  for (const Family& family : kFamilies) {
    begin(text, family.name, family.type, family.help);
    for (const auto& [name, value] : values)
      if (name.rfind(family.samples, 0) == 0) sample(text, name, value);
  }
  HttpResponse response;
  response.content_type = "text/plain; version=0.0.4; charset=utf-8";
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::move(text);
  return response;
}

}  // namespace lather::server
