#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lather::server {

/// Lines over a stream socket. Reading belongs to one thread; so does writing.
class LineSocket {
 public:
  enum class Read { kData, kNothingNow, kEnd };

  /// Does not own `fd`. A peer that sends a line longer than `longest_line` bytes is taken as ended.
  explicit LineSocket(int fd, std::size_t longest_line) : fd_(fd), longest_line_(longest_line) {}

  /// Takes in what has arrived; with `wait`, waits for something.
  [[nodiscard]] Read receive(bool wait);
  /// The next whole line, without its newline.
  [[nodiscard]] std::optional<std::string> next_line();
  /// False when the other end is gone.
  bool send(std::string_view text) const;

 private:
  int fd_;
  std::size_t longest_line_;
  std::string buffer_;
};

}  // namespace lather::server
