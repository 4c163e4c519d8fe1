#include "sim/study/stability/covering.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace lather::study {
namespace {

bool occurs_together(const std::vector<Choice>& choices, std::size_t f, int a, std::size_t g, int b) {
  for (const Choice& c : choices)
    if (c[f] == a && c[g] == b) return true;
  return false;
}

TEST(PairwiseCovering, HasEveryPairOfLevelsWithFarFewerThanAllChoices) {
  const std::vector<int> levels = {3, 2, 4, 3, 1, 3, 2, 3, 3, 4};  // 15,552 choices
  const std::vector<Choice> choices = pairwise_covering(levels);
  for (std::size_t f = 0; f < levels.size(); ++f)
    for (std::size_t g = f + 1; g < levels.size(); ++g)
      for (int a = 0; a < levels[f]; ++a)
        for (int b = 0; b < levels[g]; ++b)
          EXPECT_TRUE(occurs_together(choices, f, a, g, b)) << f << ':' << a << ' ' << g << ':' << b;
  // 16 at least, for two factors have four levels each; greedy needs less than twice as many.
  EXPECT_LT(choices.size(), 32U);
  for (const Choice& c : choices)
    for (std::size_t f = 0; f < levels.size(); ++f) EXPECT_TRUE(c[f] >= 0 && c[f] < levels[f]);
}

TEST(PairwiseCovering, OfOneFactorIsEachOfItsLevelsAndOfNoneIsNothing) {
  EXPECT_EQ(pairwise_covering({3}), (std::vector<Choice>{{0}, {1}, {2}}));
  EXPECT_TRUE(pairwise_covering({}).empty());
}

}  // namespace
}  // namespace lather::study
