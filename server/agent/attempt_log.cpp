#include "server/agent/attempt_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace lather::server {
namespace {

constexpr std::size_t kTailLines = 12;
constexpr std::size_t kLongestLine = 400;
constexpr std::string_view kFullNote = "\n… the log is full; what came after this is not kept\n";

}  // namespace

AttemptLog::AttemptLog(const std::filesystem::path& file, std::size_t most_bytes)
    : fd_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644)),
      room_(most_bytes) {
  if (!fd_) throw std::system_error(errno, std::generic_category(), "cannot create " + file.string());
}

void AttemptLog::append(std::string_view bytes) {
  remember(bytes);
  if (room_ == 0) return;
  const std::size_t taken = std::min(room_, bytes.size());
  write(bytes.substr(0, taken));
  room_ -= taken;
  if (room_ == 0) write(kFullNote);
}

std::string AttemptLog::tail() const {
  std::string text;
  for (const std::string& line : lines_) {
    if (line.empty()) continue;
    if (!text.empty()) text += '\n';
    text += line;
  }
  return text;
}

void AttemptLog::write(std::string_view bytes) {
  // A log that cannot be written (a full disk) must not end the attempt: the frames' own errors say what is
  // wrong.
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AttemptLog::remember(std::string_view bytes) {
  if (lines_.empty()) lines_.emplace_back();
  for (const char c : bytes) {
    if (c == '\n') {
      lines_.emplace_back();
      if (lines_.size() > kTailLines + 1) lines_.pop_front();
    } else if (lines_.back().size() < kLongestLine) {
      // The tail goes into error messages: plain characters only, for a line may be cut inside one.
      lines_.back() += c >= ' ' && c <= '~' ? c : '?';
    }
  }
}

}  // namespace lather::server
