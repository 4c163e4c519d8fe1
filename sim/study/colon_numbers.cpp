#include "sim/study/colon_numbers.h"

#include <charconv>

namespace lather::study {

std::vector<double> numbers_between_colons(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    double number = 0;
    const std::from_chars_result read = std::from_chars(at, end, number);
    if (read.ec != std::errc()) return {};
    numbers.push_back(number);
    if (read.ptr == end) return numbers;
    if (*read.ptr != ':') return {};
    at = read.ptr + 1;
  }
}

}  // namespace lather::study
