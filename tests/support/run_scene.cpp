#include "tests/support/run_scene.h"

#include <gtest/gtest.h>

namespace lather::testing_support {

std::string ball_scene() {
  return R"({"lather": 1, "name": "ball", "domain": {"min": [-4, -4, -4], "max": [4, 4, 4], "boundary": "open"},
    "gravity": [0, 0, 0], "duration": 0.1, "frame_rate": 10, "spacing": 0.025,
    "materials": [{"name": "foam", "preset": "shaving-cream", "tear_threshold": "infinity"}],
    "bodies": [{"name": "ball", "material": "foam", "shape": {"type": "sphere", "radius": 0.1, "translate": [0.71, 0.33, 0]}}],
    "numerics": {"time_step": 2.5e-4}})";
}

Report run(const std::string& scene_json, const std::vector<Override>& overrides, int threads,
           KernelLevel level) {
  const Scene scene = parse_scene(scene_json, "", overrides);
  const auto simulation = Simulation::create(make_plan(scene, {level}), threads);
  for (int i = 0; i <= scene.last_frame(); ++i)
    simulation->step_to_frame(i, [](const Progress&) { return true; });
  return simulation->report();
}

void expect_bit_equal_after_restore(const Plan& plan, int frame, int count) {
  const auto go_on = [](const Progress&) { return true; };
  const auto finish = [&](Simulation& simulation) {
    for (int i = frame + 1; i <= plan.scene.last_frame(); ++i) simulation.step_to_frame(i, go_on);
  };
  const auto whole = Simulation::create(plan, 2);
  for (int i = 0; i <= frame; ++i) whole->step_to_frame(i, go_on);
  std::vector<std::string> saved;
  for (int stop = 0; stop < count; ++stop) {
    whole->step_to_frame(frame + 1, [](const Progress&) { return false; });
    saved.push_back(whole->save());
  }
  finish(*whole);
  const FrameMeasure& expected = whole->report().frames.back();
  for (const std::string& bytes : saved) {
    const auto resumed = Simulation::create(plan, 1);
    resumed->restore(bytes);
    finish(*resumed);
    const FrameMeasure& got = resumed->report().frames.back();
    EXPECT_EQ(got.fingerprint, expected.fingerprint);
    EXPECT_EQ(got.points_inserted, expected.points_inserted);
    EXPECT_EQ(got.resampling_momentum, expected.resampling_momentum);
    EXPECT_EQ(got.mass_removed, expected.mass_removed);
    EXPECT_EQ(got.skin_volume, expected.skin_volume);
    EXPECT_EQ(got.lumped.has_value(), expected.lumped.has_value());
    if (got.lumped && expected.lumped) {
      EXPECT_EQ(got.lumped->momentum, expected.lumped->momentum);
      EXPECT_EQ(got.lumped->kinetic_energy, expected.lumped->kinetic_energy);
    }
    EXPECT_EQ(resumed->report().steps, whole->report().steps);
    for (std::size_t p = 0; p < whole->report().probes.size(); ++p)
      EXPECT_EQ(resumed->report().probes[p].values, whole->report().probes[p].values);
  }
}

}  // namespace lather::testing_support
