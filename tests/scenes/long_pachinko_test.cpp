// The pachinko board at the paper's size, as far as an hour goes. The printed step is 5e-6 s; these runs take
// the one that the plan chooses, 13 times as long, and resample every 1e-3 s.

#include <gtest/gtest.h>

#include "tests/scenes/pachinko.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

Report run(std::vector<Override> overrides) {
  overrides.push_back({"/numerics/time_step", "0"});
  overrides.push_back({"/numerics/resampling/interval", "1e-3"});
  return run_scene(scene_file("oobleck-pachinko", "paper", overrides), 0);
}

double speed_after_landing(const std::string& material) {
  const double speed = mean_speed(run(one_penguin(material)), 0.15, 0.35);
  std::printf("%s: %.3f m/s after landing\n", material.c_str(), speed);
  return speed;
}

TEST(PachinkoAtThePapersSize, OobleckBouncesOffThePinsOnWhichItsViscoplasticTwinStays) {
  EXPECT_GT(speed_after_landing("oobleck"), 2 * speed_after_landing("viscoplastic"));
}

// The board is cut above its second row, which the first penguin passes after 0.35 s.
TEST(PachinkoAtThePapersSize, WhatCameInIsThereOrHasLeft) {
  const Report r = run({{"/domain/min/1", "0.7488"}, {"/duration", "0.45"}});
  expect_balance(r);
  EXPECT_GT(r.frames.back().points_left, 10000U);
  EXPECT_GT(r.frames.back().points, 10000U);
}

}  // namespace
}  // namespace lather::testing_support
