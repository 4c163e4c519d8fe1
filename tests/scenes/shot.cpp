#include "tests/scenes/shot.h"

#include <array>
#include <cstdio>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {

Shot run_shot(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("shooting", size, overrides);
  std::array<double, 2> momentum{};  // of figure and ball along the path
  double of_ball = 0;
  const Report r = run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    momentum = {};
    simulation.visit_points([&](const PointState& p) {
      momentum[p.material] += scene.materials[p.material].density() * scene.point_volume() * p.velocity.x();
    });
    if (frame == 1) of_ball = momentum[1];
  });
  const FrameMeasure& last = r.frames.back();
  const Shot s = {last.pieces, last.largest_piece_share, momentum[0] / of_ball};
  std::printf(
      "  %d pieces, the largest %.3f of the points; momentum handed over %.3f; ball's momentum left %.3f\n",
      static_cast<int>(s.pieces), s.largest_piece, s.handed_over, momentum[1] / of_ball);
  return s;
}

}  // namespace lather::testing_support
