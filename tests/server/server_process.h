#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lather::server {

/// The real program as `lather serve` on a free port of loopback.
class ServerProcess {
 public:
  /// Returns once it says that it listens. Throws std::runtime_error with its words when it ends before.
  explicit ServerProcess(const std::filesystem::path& data, std::vector<std::string> further_arguments = {});
  ~ServerProcess();  ///< SIGKILL, if it still runs
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] std::vector<pid_t> runners() const;  ///< its children

  /// Sends the signal and waits for the end; the exit code, or minus the signal that ended it.
  int end(int signal);

 private:
  pid_t pid_ = -1;
  int port_ = 0;
};

}  // namespace lather::server
