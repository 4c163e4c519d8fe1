#include "tests/scenes/scene_run.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace lather::testing_support {

Scene scene_file(const std::string& name, const std::string& size, const std::vector<Override>& overrides) {
  const std::ifstream file(LATHER_SCENES "/" + name + ".json");
  std::stringstream text;
  text << file.rdbuf();
  return parse_scene(text.str(), size, overrides);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LATHER_SCENES))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

Report run_scene(const Scene& scene, int threads,
                 const std::function<void(int frame, const Simulation&)>& see) {
  const auto simulation = Simulation::create(make_plan(scene), threads);
  for (int i = 0; i <= scene.last_frame(); ++i) {
    simulation->step_to_frame(i, [](const Progress&) { return true; });
    if (see) see(i, *simulation);
  }
  const Report& r = simulation->report();
  std::printf("%s: %.2f s in %llu steps of %.3g s, %.0f s of computing, %.3g point-steps/s\n",
              scene.name.c_str(), r.simulated_time, static_cast<unsigned long long>(r.steps),
              r.largest_time_step, r.wall_seconds, r.point_steps_per_second);
  std::fflush(stdout);
  return r;
}

}  // namespace lather::testing_support
