#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "server/agent/agent.h"
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
  int most_streams = 8;  ///< zips at a time
};

/// The HTTP API and the page. Handlers hold no try/catch: what they throw becomes a problem document in
/// handle().
class Api {
 public:
  Api(Store& store, Agent& agent, ApiSettings settings);

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
  [[nodiscard]] HttpResponse get_report(const std::string& id);
  [[nodiscard]] HttpResponse get_probes(const HttpRequest& request, const std::string& id);
  [[nodiscard]] HttpResponse get_plan(const std::string& id);
  [[nodiscard]] HttpResponse get_log(const std::string& id);
  [[nodiscard]] std::optional<std::string> read_frame(const std::string& id, const FrameRow& frame) const;

  // api_other.cpp
  [[nodiscard]] HttpResponse post_plan(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse list_scenes() const;
  [[nodiscard]] HttpResponse get_scene(const std::string& name) const;
  [[nodiscard]] HttpResponse get_scene_picture(const HttpRequest& request, const std::string& name) const;
  [[nodiscard]] HttpResponse health();

  Store& store_;
  Agent& agent_;
  const ApiSettings settings_;
  Router router_;
  std::atomic<int> streams_{0};
};

/// A JSON answer.
[[nodiscard]] HttpResponse json_response(int status, std::string json);

}  // namespace lather::server
