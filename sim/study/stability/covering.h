#pragma once

#include <vector>

namespace lather::study {

/// One level of each factor, by index.
using Choice = std::vector<int>;

/// Choices in which every pair of levels of any two factors occurs together at least once, far fewer than all
/// choices. `levels[f]` is the number of levels of factor f, at least 1. Greedy, and the same each time: each
/// choice begins with a pair that is still missing, and takes for every other factor the level that brings in
/// most missing pairs.
[[nodiscard]] std::vector<Choice> pairwise_covering(const std::vector<int>& levels);

}  // namespace lather::study
