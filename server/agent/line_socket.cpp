#include "server/agent/line_socket.h"

#include <sys/socket.h>

#include <cerrno>

namespace lather::server {

LineSocket::Read LineSocket::receive(bool wait) {
  char chunk[65536];
  while (true) {
    const ssize_t got = ::recv(fd_, chunk, sizeof chunk, wait ? 0 : MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Read::kNothingNow;
    if (got <= 0) return Read::kEnd;
    buffer_.append(chunk, static_cast<std::size_t>(got));
    if (buffer_.size() > longest_line_ && buffer_.find('\n') == std::string::npos) return Read::kEnd;
    return Read::kData;
  }
}

std::optional<std::string> LineSocket::next_line() {
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end + 1);
  return line;
}

bool LineSocket::send(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t sent = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace lather::server
