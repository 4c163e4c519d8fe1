// Every model of material at the ends of its parameters, of scale, gravity, impact, step and numerics, under
// both solvers.

#include "sim/study/stability/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>

#include "sim/math/counter_rng.h"
#include "sim/study/stability/invariants.h"

namespace lather::study {
namespace {

constexpr int kSteps = 300;

struct Matrix {
  Solver solver = Solver::kMpm;
  std::string model;
};

std::string name_of(const Matrix& matrix) {
  std::string name = (matrix.solver == Solver::kMpm ? "Mpm_" : "Mlsrk_") + matrix.model;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void PrintTo(const Matrix& matrix, std::ostream* out) {
  *out << name_of(matrix);
}

std::vector<Matrix> matrices() {
  std::vector<Matrix> all;
  for (const Solver solver : {Solver::kMpm, Solver::kMlsrk})
    for (const std::string& model : extreme_models()) all.push_back({solver, model});
  return all;
}

class Extremes : public testing::TestWithParam<Matrix> {};

void expect_upright(const Matrix& matrix, const std::vector<Factor>& factors,
                    const std::vector<Choice>& choices) {
  const auto& [solver, model] = matrix;
  std::array<int, 4> counts = {};
  for (const Choice& choice : choices) {
    const std::string document = write_json(extreme_scene(solver, model, factors, choice, kSteps));
    const Verdict verdict = examine(parse_scene(document), {10 * kSteps});
    ++counts[static_cast<std::size_t>(verdict.outcome)];
    EXPECT_NE(verdict.outcome, Outcome::kBroken) << verdict.why << "\n" << document;
    EXPECT_NE(verdict.outcome, Outcome::kRefused) << verdict.why << "\n" << document;
    if (verdict.outcome == Outcome::kStopped) std::printf("%s\n", verdict.why.c_str());
  }
  // A program that stops at whatever it is given would be upright, too: half of the scenes hold at the least.
  EXPECT_GE(2 * counts[0], static_cast<int>(choices.size()));
  std::printf("%zu scenes of %zu factors: %d held, %d stopped with an error\n", choices.size(),
              factors.size(), counts[0], counts[2]);
}

TEST_P(Extremes, EndSoundOrWithAnErrorThatSaysWhy) {
  const std::vector<Factor> factors = extreme_factors(GetParam().solver, GetParam().model);
  std::vector<int> levels;
  for (const Factor& f : factors) levels.push_back(static_cast<int>(f.levels.size()));
  expect_upright(GetParam(), factors, pairwise_covering(levels));
}

class RandomExtremes : public testing::TestWithParam<Matrix> {};

TEST_P(RandomExtremes, EndSoundOrWithAnErrorThatSaysWhy) {
  const std::vector<Factor> factors = extreme_factors(GetParam().solver, GetParam().model);
  std::vector<Choice> choices(500);
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (std::size_t f = 0; f < factors.size(); ++f)
      choices[i].push_back(
          static_cast<int>(random_unit(1, i, f) * static_cast<double>(factors[f].levels.size())));
  expect_upright(GetParam(), factors, choices);
}

INSTANTIATE_TEST_SUITE_P(Models, RandomExtremes, testing::ValuesIn(matrices()),
                         [](const auto& test) { return name_of(test.param); });

INSTANTIATE_TEST_SUITE_P(Models, Extremes, testing::ValuesIn(matrices()),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace lather::study
