#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/server/program.h"

namespace lather::server {

/// The real program as `lather serve` on a free port of loopback.
class ServerProcess : public Program {
 public:
  /// Returns once it says that it listens. Throws std::runtime_error with its words when it ends before.
  explicit ServerProcess(const std::filesystem::path& data, std::vector<std::string> further_arguments = {});

  [[nodiscard]] int port() const { return port_; }

 private:
  int port_ = 0;
};

}  // namespace lather::server
