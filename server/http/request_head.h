#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "server/http/message.h"

/// The head of a request, read strictly. The HTTP library's own reading believes too much (two lengths,
/// bodies on GET, encoded line ends in values, unbounded heads), so it only ever sees what passed here.
namespace lather::server {

struct RequestLimits {
  std::size_t head_bytes = 16384;
  std::size_t body_bytes = std::size_t{8} << 20;
  std::size_t path_bytes = 512;
  std::size_t fields = 64;
};

struct RequestHead {
  HttpRequest request;  ///< without its body
  std::size_t body_bytes = 0;
  bool expects_continue = false;
};

/// `head` ends with the empty line.
[[nodiscard]] std::variant<RequestHead, Refusal> read_request_head(std::string_view head,
                                                                   const RequestLimits& limits);

/// %XX decoded, and '+' to a space where `plus_is_space`. False for a broken escape, or a control character.
[[nodiscard]] bool percent_decode(std::string_view text, bool plus_is_space, std::string& decoded);

}  // namespace lather::server
