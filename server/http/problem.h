#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/http/message.h"
#include "sim/error.h"

/// Errors as problem documents (RFC 9457).
namespace lather::server {

/// Thrown by a handler; becomes the answer.
class HttpError : public std::runtime_error {
 public:
  HttpError(int status, const std::string& detail, std::vector<Problem> problems = {})
      : std::runtime_error(detail), status_(status), problems_(std::move(problems)) {}

  /// A further member of the document, `json` being its value.
  HttpError& with(const std::string& member, const std::string& json) {
    members_.emplace_back(member, json);
    return *this;
  }

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] HttpResponse response() const;

 private:
  int status_;
  std::vector<Problem> problems_;
  std::vector<std::pair<std::string, std::string>> members_;
};

/// A whole answer as bytes, for a connection that is then closed: the refused request never reaches the
/// library.
[[nodiscard]] std::string refusal_bytes(const Refusal& refusal);

}  // namespace lather::server
