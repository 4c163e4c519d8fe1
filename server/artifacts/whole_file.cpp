#include "server/artifacts/whole_file.h"

#include <fcntl.h>
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

void write_synced(const fs::path& file, std::string_view bytes) {
  const OwnedFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644));
  if (!fd) fail("cannot create", file);
  write_all(fd.get(), bytes, file);
  if (::fsync(fd.get()) != 0) fail("cannot sync", file);
}

void sync_directory(const fs::path& directory) {
  const OwnedFd fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd || ::fsync(fd.get()) != 0) fail("cannot sync the directory", directory);
}

}  // namespace

void write_whole(const fs::path& file, std::string_view bytes) {
  fs::path part = file;
  part += kPartSuffix;
  try {
    write_synced(part, bytes);
    if (::rename(part.c_str(), file.c_str()) != 0) fail("cannot rename to", file);
    sync_directory(file.has_parent_path() ? file.parent_path() : fs::path("."));
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
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
