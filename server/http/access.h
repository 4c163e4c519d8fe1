#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http/message.h"

namespace lather::server {

/// Whom a request may come from. A page of another site that a user's browser shows can reach a loopback
/// server too, also by a name of its own that leads here (DNS rebinding): so the Host must be one of ours,
/// and an Origin, where the browser sends one, must be the page that this server itself serves (or that a
/// proxy serves under one of our names).
class AccessRules {
 public:
  /// Loopback names are always allowed; `hosts` are further names, without port.
  explicit AccessRules(std::vector<std::string> hosts);

  [[nodiscard]] std::optional<Refusal> check(const HttpRequest& request) const;

 private:
  [[nodiscard]] bool is_own(const std::string& origin, const std::string& host) const;

  std::vector<std::string> hosts_;
};

}  // namespace lather::server
