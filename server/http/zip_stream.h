#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lather::server {

struct ZipEntry {
  std::string name;
  std::function<std::optional<std::string>()> read;  ///< its bytes, when their turn comes
};

/// Writes a zip of the entries, stored and not compressed (pictures are), piece by piece into `write`; memory
/// is one entry at a time. False when an entry cannot be read or the sink takes no more: the archive is then
/// cut short.
[[nodiscard]] bool write_zip(const std::vector<ZipEntry>& entries,
                             const std::function<bool(std::string_view)>& write);

}  // namespace lather::server
