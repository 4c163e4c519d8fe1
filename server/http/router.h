#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace lather::server {

/// What a path's placeholders stood for, in order.
using Captures = std::vector<std::string>;

/// Finds the handler of a request by comparing path segments, never by a regular expression on what users
/// send.
class Router {
 public:
  using Handler = std::function<HttpResponse(const HttpRequest&, const Captures&)>;

  /// `pattern`: "/api/v1/jobs/{}/frames/{}.png"; a placeholder takes the rest of one segment and is not
  /// empty.
  void add(const std::string& method, const std::string& pattern, Handler handler);

  /// Throws HttpError 404 where no pattern fits; answers 405 with Allow where only other methods do. HEAD is
  /// served as GET.
  [[nodiscard]] HttpResponse route(const HttpRequest& request) const;

 private:
  struct Route {
    std::string method;
    std::vector<std::string> segments;
    Handler handler;
  };
  std::vector<Route> routes_;
};

}  // namespace lather::server
