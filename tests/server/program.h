#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lather::server {

/// The real program with some arguments, as a child.
class Program {
 public:
  /// Returns once it prints a line with `ready` in it. stderr is appended to `log`. Throws std::runtime_error
  /// with all its words when it ends before.
  Program(std::vector<std::string> arguments, const std::filesystem::path& log, const std::string& ready);
  ~Program();  ///< SIGKILL, if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] const std::string& said() const { return said_; }  ///< stdout up to the ready line
  [[nodiscard]] std::vector<pid_t> runners() const;                ///< its children

  /// Sends the signal and waits for the end; the exit code, or minus the signal that ended it.
  int end(int signal);

 private:
  pid_t pid_ = -1;
  std::string said_;
};

}  // namespace lather::server
