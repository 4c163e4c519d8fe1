#pragma once

#include <cstddef>
#include <string>

#include "sim/scene/sha256.h"

namespace lather::server {

using lather::sha256_hex;

/// `count` characters of [A-Za-z0-9_-] from the system's random numbers: 6 bits each.
[[nodiscard]] std::string random_token(std::size_t count);

}  // namespace lather::server
