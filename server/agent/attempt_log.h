#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include "server/artifacts/owned_fd.h"

namespace lather::server {

/// What a runner writes to stderr: kept in a file up to a bound, its last lines at hand for an error message.
class AttemptLog {
 public:
  /// Throws std::system_error when the file cannot be made.
  AttemptLog(const std::filesystem::path& file, std::size_t most_bytes);

  void append(std::string_view bytes);
  /// The last lines, oldest first, one string.
  [[nodiscard]] std::string tail() const;

 private:
  void write(std::string_view bytes);
  void remember(std::string_view bytes);

  OwnedFd fd_;
  std::size_t room_;
  std::deque<std::string> lines_;  // the last one may be unfinished
};

}  // namespace lather::server
