// Bodies that are mixtures: every point is of one of several materials, at random.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/plan/plan.h"
#include "sim/plan/seed.h"
#include "sim/plan/step_bound.h"

namespace lather {
namespace {

/// A square of three foams, the second of them stiff and seldom.
std::string square_of_foams() {
  return R"({"lather": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1]}, "duration": 0.1, "spacing": 0.02,
    "materials": [
      {"name": "a", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 1e3, "yield_stress": 30},
      {"name": "b", "density": 100, "bulk_modulus": 1e7, "shear_modulus": 1e3, "yield_stress": 30},
      {"name": "c", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 1e3, "yield_stress": 30}],
    "bodies": [{"name": "square", "shape": {"type": "box", "size": [0.8, 0.8, 1], "translate": [0.5, 0.5]},
                "mixture": [{"material": "c", "share": 6}, {"material": "b", "share": 1}, {"material": "a", "share": 3}]}]})";
}

std::vector<Seed> seeds(const std::vector<Override>& overrides = {}) {
  std::vector<Seed> out;
  seed_points(parse_scene(square_of_foams(), "", overrides), [&](const Seed& s) { out.push_back(s); });
  return out;
}

// Each count is binomial: N p, give or take 5 sqrt(N p (1 - p)), which one seed in two million would leave.
TEST(Mixture, SharesAreThoseAskedForAsFarAsChanceAllows) {
  for (const char* solver : {"mpm", "mlsrk"}) {
    const std::vector<Override> by = {{"/solver", solver}};
    std::array<double, 3> counts{};
    for (const Seed& s : seeds(by)) ++counts[s.material];
    const double n = counts[0] + counts[1] + counts[2];
    const std::array<double, 3> shares = {0.3, 0.1, 0.6};
    for (std::size_t m = 0; m < 3; ++m)
      EXPECT_NEAR(counts[m], n * shares[m], 5 * std::sqrt(n * shares[m] * (1 - shares[m]))) << solver << m;
    const Plan plan = make_plan(parse_scene(square_of_foams(), "", by));
    for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(static_cast<double>(plan.materials[m].points), counts[m]);
  }
}

// A point's material says nothing of its neighbour's: of 10,000 pairs along a row 0.3^2 are both of "a".
TEST(Mixture, NeighboursAreIndependent) {
  const std::vector<Seed> all = seeds({{"/solver", "mlsrk"}, {"/spacing", "0.008"}});
  double pairs = 0;
  double both = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].position.x() != all[i - 1].position.x()) continue;
    ++pairs;
    both += all[i].material == 0 && all[i - 1].material == 0 ? 1 : 0;
  }
  ASSERT_GT(pairs, 9000);
  // Pairs share points: twice the binomial's deviation covers their correlation.
  EXPECT_NEAR(both / pairs, 0.09, 10 * std::sqrt(0.09 * 0.91 / pairs));
}

TEST(Mixture, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
  const std::vector<Seed> first = seeds();
  const std::vector<Seed> again = seeds();
  const std::vector<Seed> other = seeds({{"/seed", "1"}});
  ASSERT_EQ(first.size(), other.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].material, again[i].material);
    EXPECT_EQ(first[i].position, other[i].position);
    changed += first[i].material != other[i].material ? 1 : 0;
  }
  // Two independent draws differ with the chance 1 - 0.3^2 - 0.1^2 - 0.6^2 = 0.54.
  EXPECT_GT(changed, first.size() / 3);
}

TEST(Mixture, TheStepSuitsEveryMaterialInIt) {
  const Scene scene = parse_scene(square_of_foams());
  EXPECT_DOUBLE_EQ(step_bound(scene), scene.spacing / wave_speed(scene.materials[1].law));
}

}  // namespace
}  // namespace lather
