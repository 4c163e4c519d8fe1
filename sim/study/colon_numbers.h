#pragma once

#include <string>
#include <vector>

namespace lather::study {

/// "0.01:100:21" as its numbers; empty where some part is no number.
[[nodiscard]] std::vector<double> numbers_between_colons(const std::string& text);

}  // namespace lather::study
