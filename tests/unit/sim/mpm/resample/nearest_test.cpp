// Distances from the nearest of some points, 16 places at a time, against one place after the other.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "sim/mpm/levels.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

constexpr int kPlaces = 48;
constexpr std::uint32_t kPoints = 20;
constexpr std::uint32_t kRows[3][2] = {{12, 20}, {5, 5}, {0, 7}};  // points 7 to 11 are in none

float squared_distance(const float* place, int k, const float* point) {
  float sum = 0;
  for (int a = 0; a < 3; ++a) {
    const float d = place[a * kPlaces + k] - point[a];
    sum += d * d;
  }
  return sum;
}

class Nearest : public testing::TestWithParam<KernelLevel> {
 protected:
  Nearest() {
    std::mt19937 rng(4);
    std::uniform_real_distribution<float> x(0, 8);
    for (float& p : place_) p = x(rng);
    for (float& p : points_) p = x(rng);
    for (int k = 0; k < kPlaces; ++k) {
      twin_[k] = kCap;
      for (const auto& row : kRows)
        for (std::uint32_t p = row[0]; p < row[1]; ++p)
          twin_[k] = std::min(twin_[k], squared_distance(place_, k, points_ + 3 * p));
      squared_[k] = kCap;
    }
  }
  void find(float enough) {
    mpm::kernel_table<float>(GetParam()).nearest(place_, kPlaces, {points_, kRows, 3}, enough, squared_);
  }

  static constexpr float kCap = 9;
  float place_[3 * kPlaces] = {};
  float points_[3 * kPoints] = {};
  float twin_[kPlaces] = {};
  float squared_[kPlaces] = {};
};

TEST_P(Nearest, EqualsItsScalarTwin) {
  find(0);
  // Three squares and their sum, fused or not: a few roundings of the sum.
  for (int k = 0; k < kPlaces; ++k)
    EXPECT_NEAR(squared_[k], twin_[k], 4 * std::numeric_limits<float>::epsilon() * twin_[k]);
  EXPECT_EQ(*std::max_element(squared_, squared_ + kPlaces), kCap);  // none is near that place
}

TEST_P(Nearest, LooksNoFurtherThanToBelowEnoughButNeverStopsAboveIt) {
  constexpr float kEnough = 4;
  find(kEnough);
  for (int k = 0; k < kPlaces; ++k) {
    EXPECT_GE(squared_[k], twin_[k] * (1 - 4 * std::numeric_limits<float>::epsilon()));
    EXPECT_EQ(squared_[k] < kEnough, twin_[k] < kEnough);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Nearest, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
