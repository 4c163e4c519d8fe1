#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/artifacts/owned_fd.h"

/// A request and a response as the API sees them; no type of the HTTP library.
namespace lather::server {

struct HttpRequest {
  std::string method;
  std::string path;                               ///< percent-decoded, starts with '/'
  std::map<std::string, std::string> parameters;  ///< of the query, decoded
  std::map<std::string, std::string> headers;     ///< names in lower case
  std::string body;
  bool version_1_0 = false;
  bool keep_alive = true;

  /// "" when it is not there.
  [[nodiscard]] std::string header(const std::string& lower_case_name) const {
    const auto found = headers.find(lower_case_name);
    return found == headers.end() ? std::string() : found->second;
  }
};

/// Takes some bytes of a streamed body; false when the client is gone.
using BodySink = std::function<bool(std::string_view)>;

struct HttpResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  /// In place of `body`: writes it all into the sink; false when it could not be finished.
  std::function<bool(const BodySink&)> stream;
  /// In place of both: takes the connection over, which is closed when whoever took it wants no more. `head`
  /// are the bytes of status line and header fields, still to be sent.
  std::function<void(OwnedFd connection, std::string head)> take_over;
};

/// Why a request is turned down before anyone looks at what it asks for.
struct Refusal {
  int status = 400;
  std::string detail;
};

/// "Not Found" for 404, and so on.
[[nodiscard]] const char* reason_phrase(int status);

}  // namespace lather::server
