#include "server/http/router.h"

#include <set>
#include <utility>

#include "server/http/problem.h"

namespace lather::server {
namespace {

constexpr std::string_view kPlaceholder = "{}";

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::size_t end = path.find('/');
    segments.emplace_back(path.substr(0, end));
    if (end == std::string_view::npos) break;
    path.remove_prefix(end);
  }
  return segments;
}

bool fits_segment(std::string_view pattern, std::string_view segment, Captures& captures) {
  const std::size_t place = pattern.find(kPlaceholder);
  if (place == std::string_view::npos) return pattern == segment;
  const std::string_view before = pattern.substr(0, place);
  const std::string_view after = pattern.substr(place + kPlaceholder.size());
  if (segment.size() <= before.size() + after.size()) return false;
  if (segment.substr(0, before.size()) != before) return false;
  if (segment.substr(segment.size() - after.size()) != after) return false;
  captures.emplace_back(segment.substr(before.size(), segment.size() - before.size() - after.size()));
  return true;
}

bool fits(const std::vector<std::string>& pattern, const std::vector<std::string>& path, Captures& captures) {
  captures.clear();
  if (pattern.size() != path.size()) return false;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!fits_segment(pattern[i], path[i], captures)) return false;
  return true;
}

HttpResponse refuse_method(const HttpRequest& request, const std::set<std::string>& methods) {
  std::string allow;
  for (const std::string& method : methods) allow += (allow.empty() ? "" : ", ") + method;
  HttpResponse response =
      HttpError(405, request.method + " is not possible here; possible: " + allow).response();
  response.headers.emplace_back("Allow", allow);
  return response;
}

}  // namespace

void Router::add(const std::string& method, const std::string& pattern, Handler handler) {
  routes_.push_back({method, split(pattern), std::move(handler)});
}

HttpResponse Router::route(const HttpRequest& request) const {
  const std::vector<std::string> path = split(request.path);
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  std::set<std::string> methods;
  Captures captures;
  for (const Route& route : routes_) {
    if (!fits(route.segments, path, captures)) continue;
    if (route.method == method) return route.handler(request, captures);
    methods.insert(route.method);
    if (route.method == "GET") methods.insert("HEAD");
  }
  if (methods.empty()) throw HttpError(404, "there is nothing at this path");
  return refuse_method(request, methods);
}

}  // namespace lather::server
