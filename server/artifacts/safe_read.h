#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "server/artifacts/owned_fd.h"

/// Files of jobs are read safely: never outside their root, never through a symbolic link.
namespace lather::server {

/// Opens the regular file `relative` below `root` for reading; no descriptor when there is none, when the way
/// leads out of `root` or over a symbolic link, or when `relative` is absolute or holds "..", "//" or NUL.
[[nodiscard]] OwnedFd open_beneath(const std::filesystem::path& root, std::string_view relative);

/// The same without openat2, for kernels that lack it: one openat(O_NOFOLLOW) per part of the path.
[[nodiscard]] OwnedFd open_beneath_stepwise(const std::filesystem::path& root, std::string_view relative);

/// The whole file, or none where open_beneath gives none or the file is larger than `limit` bytes.
[[nodiscard]] std::optional<std::string> read_beneath(const std::filesystem::path& root,
                                                      std::string_view relative,
                                                      std::size_t limit = std::size_t{1} << 30);

}  // namespace lather::server
