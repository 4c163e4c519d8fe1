#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lather::server {

/// SHA-256 as 64 hex digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

/// `count` characters of [A-Za-z0-9_-] from the system's random numbers: 6 bits each.
[[nodiscard]] std::string random_token(std::size_t count);

}  // namespace lather::server
