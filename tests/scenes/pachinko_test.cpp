// Penguins of oobleck on a pachinko board [Foam Fig. 14]: they bounce at first; what comes in is there or has
// left.

#include "tests/scenes/pachinko.h"

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

double speed_after_landing(const std::string& material) {
  const Report r = run_scene(scene_file("oobleck-pachinko", "preview", one_penguin(material)), 1);
  const double speed = mean_speed(r, 0.15, 0.35);
  std::printf("%s: %.3f m/s after landing\n", material.c_str(), speed);
  return speed;
}

TEST(Pachinko, OobleckBouncesOffThePinsOnWhichItsViscoplasticTwinStays) {
  EXPECT_GT(speed_after_landing("oobleck"), 2 * speed_after_landing("viscoplastic"));
}

// The board is cut below its third row, so that penguins leave early.
TEST(Pachinko, WhatCameInIsThereOrHasLeft) {
  const Report r = run_scene(scene_file("oobleck-pachinko", "preview",
                                        {{"/domain/min/1", "0.576"},
                                         {"/emitters/0/count", "1"},
                                         {"/emitters/1/count", "1"},
                                         {"/emitters/2/count", "2"},
                                         {"/duration", "0.8"}}),
                             1);
  expect_balance(r);
  EXPECT_GT(r.frames.back().points_left, 500U);
  EXPECT_GT(r.frames.back().points, 500U);
  EXPECT_GT(r.frames.back().points_inserted, 0U);
}

}  // namespace
}  // namespace lather::testing_support
