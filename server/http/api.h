#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "server/agent/agent.h"
#include "server/agent/counters.h"
#include "server/http/event_streams.h"
#include "server/http/film.h"
#include "server/http/limits.h"
#include "server/http/message.h"
#include "server/http/router.h"
#include "server/store/store.h"
#include "sim/export/frame_files.h"

namespace lather::server {

struct ApiSettings {
  std::filesystem::path data;
  std::filesystem::path scenes;  ///< directory of example scenes; empty: none
  JobLimits limits;
  std::size_t most_queued = 10'000;
  int most_streams = 8;           ///< zips at a time
  int most_films = 2;             ///< made at a time, for an encoder takes two cores
  std::string ffmpeg = "ffmpeg";  ///< program that makes films; looked for on PATH when it is asked for
  EventStreamSettings events;     ///< server-sent events
  std::uint64_t least_disk = std::uint64_t{64} << 20;  ///< free bytes below which the server is not ready
};

/// The HTTP API and the page. Handlers hold no try/catch: what they throw becomes a problem document in
/// handle().
class Api {
 public:
  Api(Store& store, Agent& agent, Counters& counters, ApiSettings settings);

  /// From many threads at once.
  [[nodiscard]] HttpResponse handle(const HttpRequest& request);

 private:
  void add_job_routes();
  void add_artifact_routes();
  void add_other_routes();

  // api_jobs.cpp
  [[nodiscard]] HttpResponse post_job(const HttpRequest& request);
  [[nodiscard]] HttpResponse post_render(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse add_job(const Submission& submission);
  [[nodiscard]] HttpResponse list_jobs(const HttpRequest& request);
  [[nodiscard]] HttpResponse cancel_job(const std::string& id);
  [[nodiscard]] HttpResponse pause_job(const std::string& id);
  [[nodiscard]] HttpResponse resume_job(const std::string& id);
  [[nodiscard]] HttpResponse retry_job(const std::string& id);
  [[nodiscard]] HttpResponse extend_job(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse set_priority(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse queued_again(const std::string& id);
  void require_room_in_queue();
  [[nodiscard]] HttpResponse delete_job(const std::string& id);
  [[nodiscard]] Job need_job(const std::string& id);
  [[nodiscard]] HttpResponse job_response(int status, const Job& job);

  // api_artifacts.cpp
  [[nodiscard]] HttpResponse list_frames(const std::string& id);
  [[nodiscard]] HttpResponse get_frame(const HttpRequest& request, const std::string& id,
                                       const std::string& number);
  [[nodiscard]] HttpResponse get_file(const std::string& id, const std::string& number,
                                      const FrameFileKind& kind);
  [[nodiscard]] FrameRow need_frame(const Job& job, const std::string& number);
  [[nodiscard]] HttpResponse get_zip(const std::string& id);
  [[nodiscard]] HttpResponse get_film(const HttpRequest& request, const std::string& id, FilmKind kind);
  [[nodiscard]] HttpResponse get_report(const std::string& id);
  [[nodiscard]] HttpResponse get_probes(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse get_plan(const std::string& id);
  [[nodiscard]] HttpResponse get_log(const std::string& id);
  [[nodiscard]] std::optional<std::string> read_frame(const std::string& id, const FrameRow& frame) const;

  // api_watch.cpp
  [[nodiscard]] HttpResponse get_events(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse health();
  [[nodiscard]] HttpResponse readiness();
  [[nodiscard]] HttpResponse metrics();

  // api_other.cpp
  [[nodiscard]] HttpResponse post_plan(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse list_scenes() const;
  [[nodiscard]] HttpResponse get_scene(const std::string& name) const;
  [[nodiscard]] HttpResponse get_scene_picture(const HttpRequest& request, const std::string& name) const;

  Store& store_;
  Agent& agent_;
  Counters& counters_;
  const ApiSettings settings_;
  EventStreams events_;
  Router router_;
  std::atomic<int> streams_{0};
  std::atomic<int> films_{0};
};

/// 503 with Retry-After.
[[nodiscard]] HttpResponse busy_response(const std::string& why);

/// A JSON answer.
[[nodiscard]] HttpResponse json_response(int status, std::string json);

}  // namespace lather::server
