#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

namespace lather::server {

struct ByteRange {
  std::size_t first = 0;
  std::size_t size = 0;
};
struct NoRange {};             ///< the header asks for nothing that is understood: send all
struct UnsatisfiableRange {};  ///< 416

/// One range of a Range header ("bytes=0-99", "bytes=100-", "bytes=-10") on `total` bytes.
[[nodiscard]] std::variant<ByteRange, NoRange, UnsatisfiableRange> read_range(std::string_view header,
                                                                              std::size_t total);

}  // namespace lather::server
