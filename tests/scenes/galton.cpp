#include "tests/scenes/galton.h"

#include "tests/scenes/coverage.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {

double area_kept(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("galton-board", size, overrides);
  const Box3 tank{{-0.5, 0, 0}, {0.5, scene.domain.box.max.y(), 0}};
  double first = 0;
  double sum = 0;
  int frames = 0;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    if (frame == 0) first = covered_volume(scene, simulation, tank);
    if (frame / scene.frame_rate < scene.duration - 0.25) return;
    sum += covered_volume(scene, simulation, tank);
    ++frames;
  });
  return sum / frames / first / (1 - compression_under_weight(scene, first / tank.extent().x()));
}

}  // namespace lather::testing_support
