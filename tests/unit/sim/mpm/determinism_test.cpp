// The same answer, every time: for any number of threads, and after save and restore.

#include <gtest/gtest.h>

#include "tests/support/kernel_levels.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// Foam and oobleck fall on frictional ground beside an adhesive moving block; points sort, yield and
/// collide.
std::string busy_scene(const char* precision) {
  return std::string(
             R"({"lather": 1, "name": "busy", "domain": {"min": [-0.3, 0, -0.3], "max": [0.3, 0.6, 0.3]},
    "duration": 0.08, "frame_rate": 50, "spacing": 0.03, "jitter": 0.3, "seed": 7,
    "materials": [{"name": "foam", "preset": "shaving-cream", "tear_threshold": "infinity"},
                  {"name": "goo", "preset": "oobleck", "tear_threshold": "infinity"}],
    "bodies": [
      {"name": "a", "material": "foam", "shape": {"type": "sphere", "radius": 0.1, "translate": [0, 0.2, 0]}, "velocity": [0, -2, 0]},
      {"name": "b", "material": "goo", "shape": {"type": "box", "size": [0.12, 0.12, 0.12], "translate": [0.1, 0.42, 0]}, "velocity": [-0.5, -3, 0]}],
    "obstacles": [
      {"name": "ground", "shape": {"type": "plane", "translate": [0, 0.06, 0]}, "friction": 0.4},
      {"name": "block", "shape": {"type": "box", "size": [0.1, 0.3, 0.3], "translate": [-0.14, 0.2, 0]}, "adhesive": true,
       "motion": {"type": "oscillation", "direction": [1, 0, 0], "amplitude": 0.02, "frequency": 8}}],
    "numerics": {"precision": ")") +
         precision + R"("}})";
}

/// The same with tearing, recovery, resampling, removal, emitters, probes and a skin.
std::vector<Override> with_everything_on() {
  return {{"/materials",
           R"([{"name": "foam", "preset": "shaving-cream", "tear_threshold": 0.3, "recovery_time": 0.05},
                         {"name": "goo", "preset": "oobleck", "tear_threshold": "infinity"}])"},
          {"/emitters",
           R"([{"name": "drops", "material": "foam", "velocity": [0, -3, 0], "interval": 0.02, "count": 3,
                         "shape": {"type": "sphere", "radius": 0.04, "translate": [0.2, 0.5, 0.2]}}])"},
          {"/probes", R"([{"type": "force", "name": "load", "obstacle": "ground"},
                      {"type": "point", "name": "inside", "at": [0, 0.2, 0]},
                      {"type": "plane", "name": "gate", "point": [0.2, 0.4, 0.2], "normal": [0, 1, 0]}])"},
          {"/numerics/resampling", R"({"interval": 1e-3})"},
          {"/numerics/subgrid_removal", R"({"interval": 1e-3, "anisotropy": 0.2})"},
          {"/output/skin", R"(["ply"])"}};
}

class Determinism : public testing::TestWithParam<KernelLevel> {};

TEST_P(Determinism, FinalStateIsBitEqualForAnyNumberOfThreads) {
  for (const char* precision : {"float", "double"}) {
    const std::vector<Override> shorter = {{"/duration", precision[0] == 'f' ? "0.08" : "0.04"}};
    const Report one = run(busy_scene(precision), shorter, 1, GetParam());
    ASSERT_GT(one.frames.back().elastic_shear_energy, 0);
    ASSERT_NE(one.frames.front().fingerprint, one.frames.back().fingerprint);
    for (const int threads : {2, 3, 8}) {
      const Report many = run(busy_scene(precision), shorter, threads, GetParam());
      EXPECT_EQ(many.steps, one.steps);
      for (std::size_t f = 0; f < one.frames.size(); ++f)
        EXPECT_EQ(many.frames[f].fingerprint, one.frames[f].fingerprint)
            << precision << ", frame " << f << ", " << threads;
    }
  }
}

TEST_P(Determinism, WithEverythingOnItIsBitEqualForAnyNumberOfThreads) {
  const Report one = run(busy_scene("float"), with_everything_on(), 1, GetParam());
  const FrameMeasure& last = one.frames.back();
  // Each part has had something to do.
  ASSERT_GT(last.points_inserted, 0U);
  ASSERT_GT(last.points_removed, 0U);
  ASSERT_GT(last.points_emitted, 0U);
  ASSERT_GT(last.weak_fraction, 0);
  EXPECT_EQ(one.frames[0].points + last.points_emitted + last.points_inserted,
            last.points + last.points_left + last.points_merged + last.points_removed);
  const Report many = run(busy_scene("float"), with_everything_on(), 3, GetParam());
  for (std::size_t f = 0; f < one.frames.size(); ++f) {
    EXPECT_EQ(many.frames[f].fingerprint, one.frames[f].fingerprint) << f;
    EXPECT_EQ(many.frames[f].mass_removed, one.frames[f].mass_removed);
    EXPECT_EQ(many.frames[f].skin_volume, one.frames[f].skin_volume);
  }
  for (std::size_t p = 0; p < one.probes.size(); ++p)
    EXPECT_EQ(many.probes[p].values, one.probes[p].values) << one.probes[p].name;
}

// Some of the checkpoints are made right after a resampling or a release, before the next sort.
TEST_P(Determinism, WithEverythingOnARestoredRunGoesOnBitEqual) {
  testing_support::expect_bit_equal_after_restore(
      make_plan(parse_scene(busy_scene("float"), "", with_everything_on()), {GetParam()}), 2, 8);
}

TEST_P(Determinism, ARestoredRunGoesOnBitEqual) {
  testing_support::expect_bit_equal_after_restore(make_plan(parse_scene(busy_scene("float")), {GetParam()}),
                                                  2, 5);
}

TEST_P(Determinism, DamagedOrForeignCheckpointsAreRefused) {
  const auto simulation = Simulation::create(make_plan(parse_scene(busy_scene("float")), {GetParam()}), 1);
  const std::string good = simulation->save();
  EXPECT_THROW(simulation->restore(good.substr(0, good.size() - 1)), InputError);
  EXPECT_THROW(simulation->restore(good + "x"), InputError);
  EXPECT_THROW(simulation->restore("not a checkpoint at all"), InputError);
  const auto other = Simulation::create(make_plan(parse_scene(busy_scene("double")), {GetParam()}), 1);
  EXPECT_THROW(other->restore(good), InputError);
}

INSTANTIATE_TEST_SUITE_P(Levels, Determinism, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
