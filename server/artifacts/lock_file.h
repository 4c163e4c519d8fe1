#pragma once

#include <filesystem>

#include "server/artifacts/owned_fd.h"

namespace lather::server {

/// Keeps a second server off a data directory for as long as it lives, by flock on DIRECTORY/lock. Ends with
/// the process that holds it, however that ends.
class LockFile {
 public:
  /// Throws std::runtime_error when another process holds the lock.
  explicit LockFile(const std::filesystem::path& directory);

 private:
  OwnedFd fd_;
};

}  // namespace lather::server
