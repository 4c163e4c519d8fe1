// A disk that fails: loaded before the C library (LD_PRELOAD), it answers every Nth write or sync of a file
// below the directory LATHER_TEST_DISK with EIO, for as long as the file LATHER_TEST_DISK/fail is there and
// holds N.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<unsigned> calls{0};

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// 0: it does not fail now.
unsigned every(const char* disk) {
  char flag[512];
  std::snprintf(flag, sizeof flag, "%s/fail", disk);
  const int fd = ::open(flag, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return 0;
  char text[16] = {};
  const ssize_t got = ::read(fd, text, sizeof text - 1);
  ::close(fd);
  return got > 0 ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : 0;
}

bool fails(int fd) {
  static const char* const disk = std::getenv("LATHER_TEST_DISK");
  if (disk == nullptr) return false;
  char link[64];
  char path[512] = {};
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  if (::readlink(link, path, sizeof path - 1) <= 0) return false;
  if (std::strncmp(path, disk, std::strlen(disk)) != 0) return false;
  const unsigned period = every(disk);
  if (period == 0 || ++calls % period != 0) return false;
  errno = EIO;
  return true;
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* bytes, size_t size) {
  static auto* const real = next<ssize_t(int, const void*, size_t)>("write");
  return fails(fd) ? -1 : real(fd, bytes, size);
}

ssize_t pwrite64(int fd, const void* bytes, size_t size, off64_t at) {
  static auto* const real = next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return fails(fd) ? -1 : real(fd, bytes, size, at);
}

int fsync(int fd) {
  static auto* const real = next<int(int)>("fsync");
  return fails(fd) ? -1 : real(fd);
}

int fdatasync(int fd) {
  static auto* const real = next<int(int)>("fdatasync");
  return fails(fd) ? -1 : real(fd);
}

}  // extern "C"
