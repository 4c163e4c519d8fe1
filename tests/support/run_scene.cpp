#include "tests/support/run_scene.h"

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

}  // namespace lather::testing_support
