#pragma once

#include <chrono>
#include <map>
#include <string>

namespace lather::server {

struct RawResponse {
  int status = 0;                              ///< 0: the connection ended without an answer
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;                            ///< chunks joined
};

/// Sends the bytes as they are to the port on loopback and reads until the other end closes, or until
/// `patience`.
[[nodiscard]] RawResponse exchange(int port, const std::string& bytes,
                                   std::chrono::seconds patience = std::chrono::seconds(60));

/// A well-formed request over a connection of its own.
[[nodiscard]] RawResponse request(int port, const std::string& method, const std::string& path,
                                  const std::string& body = {}, const std::string& header_lines = {});

/// A connection that stays open; closed by close().
[[nodiscard]] int connect_to(int port);

}  // namespace lather::server
