#include "server/http/access.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace lather::server {
namespace {

/// "name:port", "[v6]:port" or the same without port -> the name, lower case.
std::string host_name(std::string_view authority) {
  const std::size_t bracket = authority.find(']');
  const std::size_t from = bracket == std::string_view::npos ? 0 : bracket;
  std::string name(authority.substr(0, authority.find(':', from)));
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_loopback(const std::string& name) {
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

}  // namespace

AccessRules::AccessRules(std::vector<std::string> hosts) : hosts_(std::move(hosts)) {}

std::optional<Refusal> AccessRules::check(const HttpRequest& request) const {
  const std::string host = request.header("host");
  const std::string name = host_name(host);
  if (!is_loopback(name) && !contains(hosts_, name))
    return Refusal{403, "this server does not answer to the host '" + host.substr(0, 100) +
                            "': start it with --allow-host NAME"};
  const auto origin = request.headers.find("origin");
  if (origin == request.headers.end() || is_own(origin->second, host)) return std::nullopt;
  return Refusal{403, "requests from pages of other origins are not taken"};
}

bool AccessRules::is_own(const std::string& origin, const std::string& host) const {
  const std::size_t scheme = origin.find("://");
  if (scheme == std::string::npos) return false;
  const std::string authority = origin.substr(scheme + 3);
  return authority == host || contains(hosts_, host_name(authority));
}

}  // namespace lather::server
