#include "server/http/api.h"

#include <utility>

#include "server/http/page.h"
#include "server/http/problem.h"
#include "sim/scene/scene.h"

namespace lather::server {
namespace {

std::string api_path(const char* rest) {
  return std::string("/api/v1") + rest;
}

}  // namespace

Api::Api(Store& store, Agent& agent, Counters& counters, ApiSettings settings)
    : store_(store),
      agent_(agent),
      counters_(counters),
      settings_(std::move(settings)),
      events_(store, settings_.events) {
  add_job_routes();
  add_artifact_routes();
  add_other_routes();
}

HttpResponse Api::handle(const HttpRequest& request) {
  try {
    return router_.route(request);
  } catch (const HttpError& error) {
    return error.response();
  } catch (const InputError& error) {
    return HttpError(422, "the request cannot be used", error.problems()).response();
  }
}

void Api::add_job_routes() {
  const auto add = [this](const char* method, const char* path, Router::Handler handler) {
    router_.add(method, api_path(path), std::move(handler));
  };
  add("POST", "/jobs", [this](const HttpRequest& request, const Captures&) { return post_job(request); });
  add("GET", "/jobs", [this](const HttpRequest& request, const Captures&) { return list_jobs(request); });
  add("GET", "/jobs/{}",
      [this](const HttpRequest&, const Captures& at) { return job_response(200, need_job(at[0])); });
  add("DELETE", "/jobs/{}", [this](const HttpRequest&, const Captures& at) { return delete_job(at[0]); });
  add("POST", "/jobs/{}/render",
      [this](const HttpRequest& request, const Captures& at) { return post_render(request, at[0]); });
  add("POST", "/jobs/{}/cancel",
      [this](const HttpRequest&, const Captures& at) { return cancel_job(at[0]); });
  add("POST", "/jobs/{}/pause", [this](const HttpRequest&, const Captures& at) { return pause_job(at[0]); });
  add("POST", "/jobs/{}/resume",
      [this](const HttpRequest&, const Captures& at) { return resume_job(at[0]); });
  add("POST", "/jobs/{}/retry", [this](const HttpRequest&, const Captures& at) { return retry_job(at[0]); });
  add("POST", "/jobs/{}/extend",
      [this](const HttpRequest& request, const Captures& at) { return extend_job(request, at[0]); });
  add("POST", "/jobs/{}/priority",
      [this](const HttpRequest& request, const Captures& at) { return set_priority(request, at[0]); });
}

void Api::add_artifact_routes() {
  const auto add = [this](const char* path, Router::Handler handler) {
    router_.add("GET", api_path(path), std::move(handler));
  };
  add("/jobs/{}/events",
      [this](const HttpRequest& request, const Captures& at) { return get_events(request, at[0]); });
  add("/jobs/{}/frames", [this](const HttpRequest&, const Captures& at) { return list_frames(at[0]); });
  add("/jobs/{}/frames/{}.png",
      [this](const HttpRequest& request, const Captures& at) { return get_frame(request, at[0], at[1]); });
  for (const FrameFileKind& kind : frame_file_kinds())
    router_.add(
        "GET", api_path("/jobs/{}/") + kind.folder + "/{}." + kind.ending,
        [this, kind](const HttpRequest&, const Captures& at) { return get_file(at[0], at[1], kind); });
  add("/jobs/{}/frames.zip", [this](const HttpRequest&, const Captures& at) { return get_zip(at[0]); });
  for (const auto& [ending, kind] : {std::pair("mp4", FilmKind::kMp4), std::pair("webm", FilmKind::kWebm)})
    router_.add("GET", api_path("/jobs/{}/film.") + ending,
                [this, kind = kind](const HttpRequest& request, const Captures& at) {
                  return get_film(request, at[0], kind);
                });
  add("/jobs/{}/report", [this](const HttpRequest&, const Captures& at) { return get_report(at[0]); });
  add("/jobs/{}/probes.csv",
      [this](const HttpRequest& request, const Captures& at) { return get_probes(request, at[0]); });
  add("/jobs/{}/plan", [this](const HttpRequest&, const Captures& at) { return get_plan(at[0]); });
  add("/jobs/{}/log", [this](const HttpRequest&, const Captures& at) { return get_log(at[0]); });
}

void Api::add_other_routes() {
  const auto add = [this](const char* method, const std::string& path, Router::Handler handler) {
    router_.add(method, path, std::move(handler));
  };
  add("POST", api_path("/plan"),
      [this](const HttpRequest& request, const Captures&) { return post_plan(request); });
  add("GET", api_path("/scenes"), [this](const HttpRequest&, const Captures&) { return list_scenes(); });
  // Before the scenes themselves, whose pattern takes every name.
  add("GET", api_path("/scenes/{}.jpg"),
      [this](const HttpRequest& request, const Captures& at) { return get_scene_picture(request, at[0]); });
  add("GET", api_path("/scenes/{}"),
      [this](const HttpRequest&, const Captures& at) { return get_scene(at[0]); });
  add("GET", api_path("/schema"),
      [](const HttpRequest&, const Captures&) { return json_response(200, scene_schema()); });
  add("GET", api_path("/materials"),
      [](const HttpRequest&, const Captures&) { return json_response(200, material_cards()); });
  add("GET", "/readyz", [this](const HttpRequest&, const Captures&) { return readiness(); });
  add("GET", "/metrics", [this](const HttpRequest&, const Captures&) { return metrics(); });
  add("GET", "/healthz", [this](const HttpRequest&, const Captures&) { return health(); });
  add("GET", "/",
      [](const HttpRequest& request, const Captures&) { return page_response(request, "index.html"); });
  add("GET", "/{}",
      [](const HttpRequest& request, const Captures& at) { return page_response(request, at[0]); });
}

HttpResponse busy_response(const std::string& why) {
  HttpResponse busy = HttpError(503, why + ": try again").response();
  busy.headers.emplace_back("Retry-After", "5");
  return busy;
}

HttpResponse json_response(int status, std::string json) {
  HttpResponse response;
  response.status = status;
  response.body = std::move(json);
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

}  // namespace lather::server
