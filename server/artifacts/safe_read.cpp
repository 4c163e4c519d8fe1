#include "server/artifacts/safe_read.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace lather::server {
namespace {

constexpr int kReadFlags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;

/// The parts of a relative path; empty when it is not plain.
std::vector<std::string> plain_parts(std::string_view relative) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t slash = relative.find('/');
    const std::string part(relative.substr(0, slash));
    if (part.empty() || part == "." || part == ".." || part.find('\0') != std::string::npos) return {};
    parts.push_back(part);
    if (slash == std::string_view::npos) return parts;
    relative.remove_prefix(slash + 1);
  }
}

OwnedFd open_root(const std::filesystem::path& root) {
  return OwnedFd(::open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
}

OwnedFd only_regular(OwnedFd fd) {
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return fd;
}

}  // namespace

OwnedFd open_beneath(const std::filesystem::path& root, std::string_view relative) {
  if (plain_parts(relative).empty()) return {};
  const OwnedFd directory = open_root(root);
  if (!directory) return {};
  open_how how{};
  how.flags = kReadFlags;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  const std::string path(relative);
  const long fd = ::syscall(SYS_openat2, directory.get(), path.c_str(), &how, sizeof how);
  if (fd < 0 && (errno == ENOSYS || errno == EPERM)) return open_beneath_stepwise(root, relative);
  return only_regular(OwnedFd(static_cast<int>(fd)));
}

OwnedFd open_beneath_stepwise(const std::filesystem::path& root, std::string_view relative) {
  const std::vector<std::string> parts = plain_parts(relative);
  if (parts.empty()) return {};
  OwnedFd at = open_root(root);
  for (std::size_t i = 0; at && i < parts.size(); ++i) {
    const bool last = i + 1 == parts.size();
    const int flags = last ? kReadFlags : O_PATH | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW;
    at = OwnedFd(::openat(at.get(), parts[i].c_str(), flags));
  }
  return only_regular(std::move(at));
}

std::optional<std::string> read_beneath(const std::filesystem::path& root, std::string_view relative,
                                        std::size_t limit) {
  const OwnedFd fd = open_beneath(root, relative);
  if (!fd) return std::nullopt;
  std::string bytes;
  char chunk[65536];
  while (true) {
    const ssize_t got = ::read(fd.get(), chunk, sizeof chunk);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 || bytes.size() + static_cast<std::size_t>(std::max<ssize_t>(got, 0)) > limit)
      return std::nullopt;
    if (got == 0) return bytes;
    bytes.append(chunk, static_cast<std::size_t>(got));
  }
}

}  // namespace lather::server
