#include "server/http/byte_range.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace lather::server {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::variant<ByteRange, NoRange, UnsatisfiableRange> read_range(std::string_view header, std::size_t total) {
  static constexpr std::string_view kUnit = "bytes=";
  if (header.substr(0, kUnit.size()) != kUnit) return NoRange{};
  header.remove_prefix(kUnit.size());
  const std::size_t dash = header.find('-');
  if (dash == std::string_view::npos) return NoRange{};
  const std::string_view from = header.substr(0, dash);
  const std::string_view to = header.substr(dash + 1);
  const std::optional<std::size_t> first = whole_number(from);
  const std::optional<std::size_t> last = whole_number(to);
  if (from.empty()) {
    if (!last) return NoRange{};
    if (*last == 0 || total == 0) return UnsatisfiableRange{};
    const std::size_t size = std::min(*last, total);
    return ByteRange{total - size, size};
  }
  if (!first || (!to.empty() && !last) || (last && *last < *first)) return NoRange{};
  if (*first >= total) return UnsatisfiableRange{};
  const std::size_t end = last ? std::min(*last, total - 1) : total - 1;
  return ByteRange{*first, end - *first + 1};
}

}  // namespace lather::server
