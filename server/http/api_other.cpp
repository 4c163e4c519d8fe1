#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "server/artifacts/digest.h"
#include "server/artifacts/safe_read.h"
#include "server/http/api.h"
#include "server/http/problem.h"
#include "server/http/submission.h"
#include "sim/scene/value.h"

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

std::string picture_path(const std::string& name) {
  return "pictures/" + name + ".jpg";
}

/// What a list says of a scene: members that it does not hold are null, and so are all of a file that cannot
/// be read.
Object scene_entry(const std::filesystem::path& scenes, const std::string& name) {
  Value scene;
  try {
    scene = parse_json(read_beneath(scenes, name + ".json", kLargestScene).value_or("null"));
  } catch (const InputError&) {
    scene = nullptr;
  }
  const auto member = [&](const char* key) {
    const Value* found = scene.find(key);
    return found ? *found : Value();
  };
  const std::string url = "/api/v1/scenes/" + name;
  return {{"name", name},
          {"title", member("name")},
          {"dimension", member("dimension")},
          {"solver", member("solver")},
          {"url", url},
          {"picture", open_beneath(scenes, picture_path(name)) ? Value(url + ".jpg") : Value()}};
}

}  // namespace

HttpResponse Api::post_plan(const HttpRequest& request) const {
  return json_response(200, to_json(read_posted_scene(request, settings_.limits).plan));
}

HttpResponse Api::list_scenes() const {
  Array scenes;
  for (const std::string& name : scene_names(settings_.scenes))
    scenes.push_back(scene_entry(settings_.scenes, name));
  return json_response(200, write_json(Object{{"scenes", std::move(scenes)}}, 2));
}

HttpResponse Api::get_scene(const std::string& name) const {
  std::optional<std::string> scene;
  if (!settings_.scenes.empty()) scene = read_beneath(settings_.scenes, name + ".json", kLargestScene);
  if (!scene) throw HttpError(404, "there is no example scene of this name");
  return json_response(200, std::move(*scene));
}

HttpResponse Api::get_scene_picture(const HttpRequest& request, const std::string& name) const {
  std::optional<std::string> picture;
  if (!settings_.scenes.empty()) picture = read_beneath(settings_.scenes, picture_path(name), kLargestScene);
  if (!picture) throw HttpError(404, "there is no picture of an example scene of this name");
  HttpResponse response;
  const std::string tag = '"' + sha256_hex(*picture) + '"';
  if (request.header("if-none-match").find(tag) != std::string::npos) {
    response.status = 304;
  } else {
    response.content_type = "image/jpeg";
    response.body = std::move(*picture);
  }
  response.headers.emplace_back("ETag", tag);
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

}  // namespace lather::server
