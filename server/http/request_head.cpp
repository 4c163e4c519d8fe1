#include "server/http/request_head.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string>

namespace lather::server {
namespace {

using Outcome = std::optional<Refusal>;

bool is_token(std::string_view text) {
  static constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Values are never decoded here, but others on the way might: an encoded line end or NUL is never meant
/// well.
bool hides_line_end(std::string_view value) {
  const std::string text = lower(value);
  return text.find("%0d") != std::string::npos || text.find("%0a") != std::string::npos ||
         text.find("%00") != std::string::npos;
}

Outcome read_query(std::string_view query, HttpRequest& request) {
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    std::string name;
    std::string value;
    if (!percent_decode(pair.substr(0, equals), true, name) ||
        !percent_decode(pair.substr(std::min(equals + 1, pair.size())), true, value))
      return Refusal{400, "the query holds a broken %-escape or a control character"};
    if (!request.parameters.emplace(name, value).second)
      return Refusal{400, "the query parameter '" + name + "' is given twice"};
  }
  return std::nullopt;
}

Outcome read_target(std::string_view target, const RequestLimits& limits, HttpRequest& request) {
  if (target.empty() || target.front() != '/')
    return Refusal{400, "the request's target must be a path that starts with '/'"};
  const std::size_t end = std::min(target.find_first_of("?#"), target.size());
  if (end > limits.path_bytes)
    return Refusal{414, "the path is longer than " + std::to_string(limits.path_bytes) + " bytes"};
  if (!percent_decode(target.substr(0, end), false, request.path))
    return Refusal{400, "the path holds a broken %-escape or a control character"};
  return read_query(target.substr(std::min(end + 1, target.size())), request);
}

Outcome read_request_line(std::string_view line, const RequestLimits& limits, HttpRequest& request) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return Refusal{400, "the request line is malformed"};
  const std::string_view version = line.substr(last + 1);
  request.method = std::string(line.substr(0, first));
  if (!is_token(request.method) || request.method.size() > 16)
    return Refusal{400, "the request's method is malformed"};
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return Refusal{505, "only HTTP/1.1 and HTTP/1.0 are spoken here"};
  request.version_1_0 = version == "HTTP/1.0";
  return read_target(line.substr(first + 1, last - first - 1), limits, request);
}

Outcome read_field(std::string_view line, HttpRequest& request) {
  static const std::set<std::string> kOnce = {"host",   "content-length", "content-type",
                                              "origin", "authorization",  "range",
                                              "expect", "idempotency-key"};
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
    return Refusal{400, "a header line is malformed"};
  const std::string name = lower(line.substr(0, colon));
  const std::string_view value = trimmed(line.substr(colon + 1));
  const auto bad = [](char c) { return is_control(c) && c != '\t'; };
  if (std::any_of(value.begin(), value.end(), bad) || hides_line_end(value))
    return Refusal{400, "the header '" + name + "' holds a line end or another control character"};
  const auto [place, added] = request.headers.emplace(name, value);
  if (added) return std::nullopt;
  if (kOnce.count(name) != 0) return Refusal{400, "the header '" + name + "' is given twice"};
  place->second += ", " + std::string(value);
  return std::nullopt;
}

Outcome read_body_length(const RequestLimits& limits, RequestHead& head) {
  const auto& headers = head.request.headers;
  const bool takes_body =
      head.request.method == "POST" || head.request.method == "PUT" || head.request.method == "PATCH";
  const auto length = headers.find("content-length");
  if (headers.count("transfer-encoding") != 0) {
    if (length != headers.end())
      return Refusal{400, "Content-Length and Transfer-Encoding exclude each other"};
    return Refusal{411, "chunked bodies are not taken: send a Content-Length"};
  }
  if (length == headers.end())
    return takes_body ? Outcome(Refusal{411, "send a Content-Length (0 for an empty body)"}) : std::nullopt;
  const char* const begin = length->second.data();
  const char* const end = begin + length->second.size();
  const auto [stop, error] = std::from_chars(begin, end, head.body_bytes);
  const bool too_long = error == std::errc::result_out_of_range;
  if (!too_long && (error != std::errc{} || stop != end || *begin < '0' || *begin > '9'))
    return Refusal{400, "Content-Length is no number"};
  if (head.body_bytes > 0 && !takes_body) return Refusal{400, "a " + head.request.method + " takes no body"};
  if (too_long || head.body_bytes > limits.body_bytes)
    return Refusal{413, "the body is larger than the " + std::to_string(limits.body_bytes) +
                            " bytes that are taken here"};
  return std::nullopt;
}

Outcome read_meaning(RequestHead& head) {
  HttpRequest& request = head.request;
  const std::string encoding = lower(request.header("content-encoding"));
  if (!encoding.empty() && encoding != "identity")
    return Refusal{415, "the body is encoded as '" + encoding + "': send it plain"};
  const std::string expect = lower(request.header("expect"));
  if (!expect.empty() && expect != "100-continue")
    return Refusal{417, "'Expect: " + expect + "' is not known"};
  head.expects_continue = !expect.empty();
  if (request.header("host").empty()) return Refusal{400, "the request has no Host header"};
  const std::string range = request.header("range");
  if (range.find(',') != std::string::npos) return Refusal{416, "one range is served at a time"};
  const std::string connection = lower(request.header("connection"));
  request.keep_alive = request.version_1_0 ? connection.find("keep-alive") != std::string::npos
                                           : connection.find("close") == std::string::npos;
  return std::nullopt;
}

Outcome read_lines(std::string_view head, const RequestLimits& limits, RequestHead& result) {
  bool first = true;
  for (std::size_t fields = 0;; ++fields) {
    const std::size_t end = head.find("\r\n");
    if (end == std::string_view::npos) return Refusal{400, "the request's head is malformed"};
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(end + 2);
    if (line.empty()) return std::nullopt;
    if (fields > limits.fields)
      return Refusal{431, "more than " + std::to_string(limits.fields) + " header fields"};
    Outcome bad = first ? read_request_line(line, limits, result.request) : read_field(line, result.request);
    if (bad) return bad;
    first = false;
  }
}

}  // namespace

std::variant<RequestHead, Refusal> read_request_head(std::string_view head, const RequestLimits& limits) {
  RequestHead result;
  Outcome bad = read_lines(head, limits, result);
  if (!bad) bad = read_body_length(limits, result);
  if (!bad) bad = read_meaning(result);
  if (bad) return *bad;
  return result;
}

bool percent_decode(std::string_view text, bool plus_is_space, std::string& decoded) {
  decoded.clear();
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_space) {
      c = ' ';
    } else if (c == '%') {
      if (i + 2 >= text.size()) return false;
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return false;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (is_control(c)) return false;
    decoded += c;
  }
  return true;
}

}  // namespace lather::server
