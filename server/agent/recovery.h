#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "server/store/store.h"

namespace lather::server {

struct Recovery {
  std::size_t jobs = 0;         ///< whose attempts were lost
  std::size_t files = 0;        ///< half-written or never published, removed
  std::size_t directories = 0;  ///< of jobs that the store does not know, removed
};

/// Where a checkpoint lies; `directory` is the job's.
[[nodiscard]] std::filesystem::path checkpoint_path(const std::filesystem::path& directory,
                                                    const CheckpointRow& row);

/// Removes the file; that it cannot be is no error, for what stays is swept later.
void remove_file(const std::filesystem::path& file);

/// Removes what an attempt that is at work no longer has left half-written, or whole but named by no row of
/// the store: pictures, the files beside them, checkpoints; and its whole directory when no row names
/// anything there and a later attempt has begun. Says how many files. `directory` is the job's.
std::size_t sweep_attempt(Store& store, const std::filesystem::path& directory, const std::string& id,
                          int attempt);

/// Puts store and data directory in order after the last server's end, whatever that was. Call it before the
/// agent starts, with the data directory's lock held. Published frames are never touched.
Recovery recover(Store& store, const std::filesystem::path& data);

}  // namespace lather::server
