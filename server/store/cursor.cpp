#include <charconv>
#include <stdexcept>

#include "server/store/store.h"

namespace lather::server {

std::int64_t sequence_of_cursor(const std::string& cursor) {
  std::int64_t sequence = 0;
  const auto [end, error] = std::from_chars(cursor.data(), cursor.data() + cursor.size(), sequence);
  if (error != std::errc{} || end != cursor.data() + cursor.size() || sequence <= 0)
    throw std::invalid_argument("'" + cursor + "' is no cursor");
  return sequence;
}

}  // namespace lather::server
