#include "server/artifacts/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace lather::server {

LockFile::LockFile(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "lock";
  fd_ = OwnedFd(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!fd_) throw std::system_error(errno, std::generic_category(), "cannot open " + file.string());
  if (::flock(fd_.get(), LOCK_EX | LOCK_NB) == 0) return;
  if (errno != EWOULDBLOCK)
    throw std::system_error(errno, std::generic_category(), "cannot lock " + file.string());
  throw std::runtime_error("another server uses the data directory " + directory.string() +
                           ": stop it, or give this one another with --data");
}

}  // namespace lather::server
