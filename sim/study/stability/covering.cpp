#include "sim/study/stability/covering.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace lather::study {
namespace {

constexpr int kUnchosen = -1;

/// Which pairs of levels of two factors are still missing.
class MissingPairs {
 public:
  explicit MissingPairs(const std::vector<int>& levels) : first_(levels.size(), 0) {
    std::partial_sum(levels.begin(), levels.end() - 1, first_.begin() + 1);
    all_ = static_cast<std::size_t>(first_.back() + levels.back());
    missing_.assign(all_ * all_, 0);
    for (std::size_t f = 0; f < levels.size(); ++f)
      for (std::size_t g = f + 1; g < levels.size(); ++g)
        for (int a = 0; a < levels[f]; ++a)
          for (int b = 0; b < levels[g]; ++b) at(f, a, g, b) = 1;
  }

  [[nodiscard]] bool has(std::size_t f, int a, std::size_t g, int b) const {
    return missing_[index(f, a, g, b)] != 0;
  }
  /// How many pairs level `a` of factor f would bring in beside what is chosen.
  [[nodiscard]] int gained(const Choice& choice, std::size_t f, int a) const {
    int sum = 0;
    for (std::size_t g = 0; g < choice.size(); ++g)
      if (g != f && choice[g] != kUnchosen) sum += has(f, a, g, choice[g]) ? 1 : 0;
    return sum;
  }
  void remove(const Choice& choice) {
    for (std::size_t f = 0; f < choice.size(); ++f)
      for (std::size_t g = f + 1; g < choice.size(); ++g) at(f, choice[f], g, choice[g]) = 0;
  }

 private:
  /// Of the pair, whichever factor is named first.
  [[nodiscard]] std::size_t index(std::size_t f, int a, std::size_t g, int b) const {
    const auto one = static_cast<std::size_t>(first_[f] + a);
    const auto other = static_cast<std::size_t>(first_[g] + b);
    return std::min(one, other) * all_ + std::max(one, other);
  }
  char& at(std::size_t f, int a, std::size_t g, int b) { return missing_[index(f, a, g, b)]; }

  std::vector<int> first_;  // number of a factor's first level among all levels of all factors
  std::size_t all_ = 0;
  std::vector<char> missing_;
};

/// The level of factor f that brings in most, the first of several.
int best_level(const MissingPairs& missing, const Choice& choice, std::size_t f, int levels) {
  int best = 0;
  for (int a = 1; a < levels; ++a)
    if (missing.gained(choice, f, a) > missing.gained(choice, f, best)) best = a;
  return best;
}

Choice completed(Choice choice, const MissingPairs& missing, const std::vector<int>& levels) {
  for (std::size_t f = 0; f < levels.size(); ++f)
    if (choice[f] == kUnchosen) choice[f] = best_level(missing, choice, f, levels[f]);
  return choice;
}

}  // namespace

std::vector<Choice> pairwise_covering(const std::vector<int>& levels) {
  std::vector<Choice> choices;
  if (levels.size() < 2) {
    for (int a = 0; !levels.empty() && a < levels[0]; ++a) choices.push_back({a});
    return choices;
  }
  MissingPairs missing(levels);
  for (std::size_t f = 0; f < levels.size(); ++f)
    for (std::size_t g = f + 1; g < levels.size(); ++g)
      for (int a = 0; a < levels[f]; ++a)
        for (int b = 0; b < levels[g]; ++b) {
          if (!missing.has(f, a, g, b)) continue;
          Choice choice(levels.size(), kUnchosen);
          choice[f] = a;
          choice[g] = b;
          choices.push_back(completed(std::move(choice), missing, levels));
          missing.remove(choices.back());
        }
  return choices;
}

}  // namespace lather::study
