#include "server/artifacts/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "server/artifacts/owned_fd.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& file) {
  throw std::system_error(errno, std::generic_category(), std::string(what) + " " + file.string());
}

void write_all(int fd, std::string_view bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write", file);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_synced(const fs::path& file, std::initializer_list<std::string_view> parts) {
  const OwnedFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644));
  if (!fd) fail("cannot create", file);
  for (const std::string_view bytes : parts) write_all(fd.get(), bytes, file);
  if (::fsync(fd.get()) != 0) fail("cannot sync", file);
}

fs::path directory_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void sync_directory(const fs::path& directory) {
  const OwnedFd fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd || ::fsync(fd.get()) != 0) fail("cannot sync the directory", directory);
}

}  // namespace

void write_whole(const fs::path& file, std::string_view bytes) {
  write_whole(file, {bytes});
}

void write_whole(const fs::path& file, std::initializer_list<std::string_view> parts) {
  fs::path part = file;
  part += kPartSuffix;
  try {
    write_synced(part, parts);
    if (::rename(part.c_str(), file.c_str()) != 0) fail("cannot rename to", file);
    sync_directory(directory_of(file));
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
}

void make_directories(const fs::path& directory) {
  if (fs::is_directory(directory)) return;
  const fs::path above = directory_of(directory);
  make_directories(above);
  if (::mkdir(directory.c_str(), 0755) != 0 && errno != EEXIST) fail("cannot make", directory);
  sync_directory(above);
}

bool remove_tree(const fs::path& directory) {
  constexpr int kTries = 8;  // each fails only where another removed something under its feet
  std::error_code failure;
  for (int i = 0; i < kTries; ++i) {
    fs::remove_all(directory, failure);
    if (!failure) return true;
  }
  return false;
}

std::size_t sweep_parts(const fs::path& root) {
  std::vector<fs::path> parts;
  std::error_code ignored;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(root, options, ignored), end; entry != end;
       entry.increment(ignored)) {
    if (entry->path().extension() == kPartSuffix && entry->is_regular_file(ignored))
      parts.push_back(entry->path());
  }
  for (const fs::path& part : parts) fs::remove(part, ignored);
  return parts.size();
}

}  // namespace lather::server
