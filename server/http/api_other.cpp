#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "server/artifacts/safe_read.h"
#include "server/http/api.h"
#include "server/http/problem.h"
#include "server/http/submission.h"
#include "sim/scene/value.h"
#include "sim/simulation.h"

namespace lather::server {
namespace {

constexpr std::size_t kLargestScene = std::size_t{8} << 20;

std::vector<std::string> scene_names(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(directory, ignored), end; entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

HttpResponse Api::post_plan(const HttpRequest& request) const {
  return json_response(200, to_json(read_posted_scene(request, settings_.limits).plan));
}

HttpResponse Api::list_scenes() const {
  Array scenes;
  for (const std::string& name : scene_names(settings_.scenes))
    scenes.push_back(Object{{"name", name}, {"url", "/api/v1/scenes/" + name}});
  return json_response(200, write_json(Object{{"scenes", std::move(scenes)}}, 2));
}

HttpResponse Api::get_scene(const std::string& name) const {
  std::optional<std::string> scene;
  if (!settings_.scenes.empty()) scene = read_beneath(settings_.scenes, name + ".json", kLargestScene);
  if (!scene) throw HttpError(404, "there is no example scene of this name");
  return json_response(200, std::move(*scene));
}

HttpResponse Api::health() {
  const auto count = [this](JobState state) { return static_cast<std::int64_t>(store_.count(state)); };
  return json_response(200, write_json(Object{{"status", "ok"},
                                              {"version", version()},
                                              {"queued", count(JobState::kQueued)},
                                              {"running", count(JobState::kRunning)}}));
}

}  // namespace lather::server
