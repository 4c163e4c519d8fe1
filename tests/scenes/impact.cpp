#include "tests/scenes/impact.h"

#include <algorithm>
#include <cstdio>

#include "sim/shape/shape.h"

namespace lather::testing_support {

Impact measure_impact(const Scene& scene, const Report& report) {
  const double ground = -distance(*scene.obstacles.front().shape, Vec3::Zero());
  const FrameMeasure& first = report.frames.front();
  const double speed = scene.bodies.front().velocity.norm();
  Impact impact;
  impact.drop_height = first.lowest.y() - ground + speed * speed / (2 * scene.gravity.norm());
  impact.body_height = first.highest.y() - first.lowest.y();
  double least = first.center_of_mass.y();
  bool landed = false;
  for (const FrameMeasure& frame : report.frames) {
    const double height = frame.center_of_mass.y();
    least = std::min(least, height);
    impact.climb = std::max(impact.climb, height - least);
    landed = landed || frame.lowest.y() < ground + scene.spacing;
    if (landed) impact.lift = std::max(impact.lift, frame.lowest.y() - ground);
  }
  impact.final_height = report.frames.back().highest.y() - ground;
  return impact;
}

void print(const std::string& name, const Impact& impact) {
  std::printf("%s: climbs %.2f %% of the drop height, lifts off by %.2f mm, ends %.0f %% as high as it was\n",
              name.c_str(), 100 * impact.climb / impact.drop_height, 1000 * impact.lift,
              100 * impact.final_height / impact.body_height);
  std::fflush(stdout);
}

}  // namespace lather::testing_support
