#pragma once

#include <cstddef>
#include <filesystem>

#include "server/store/store.h"

namespace lather::server {

struct Recovery {
  std::size_t jobs = 0;         ///< that were running and are queued again, or cancelled
  std::size_t files = 0;        ///< half-written or never published, removed
  std::size_t directories = 0;  ///< of jobs that the store does not know, removed
};

/// Puts store and data directory in order after the last server's end, whatever that was. Call it before the
/// agent starts, with the data directory's lock held. Published frames are never touched.
Recovery recover(Store& store, const std::filesystem::path& data);

}  // namespace lather::server
