#pragma once

#include <memory>
#include <string>

namespace lather::server {

/// A small HTTP client of one server's API.
class ApiClient {
 public:
  /// `url`: "http://HOST:PORT", with or without a path prefix. Throws InputError when it is none.
  explicit ApiClient(const std::string& url);
  ~ApiClient();
  ApiClient(const ApiClient&) = delete;
  ApiClient& operator=(const ApiClient&) = delete;

  struct Answer {
    int status = 0;
    std::string body;
  };
  /// `path` starts with '/'. Throws std::runtime_error when the server cannot be reached.
  [[nodiscard]] Answer get(const std::string& path);
  /// JSON. A repeated key makes nothing anew.
  [[nodiscard]] Answer post(const std::string& path, const std::string& body,
                            const std::string& idempotency_key = {});

 private:
  class Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace lather::server
