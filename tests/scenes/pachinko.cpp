#include "tests/scenes/pachinko.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lather::testing_support {

std::vector<Override> one_penguin(const std::string& material) {
  return {{"/materials/0/preset", material},
          {"/emitters/0/count", "1"},
          {"/emitters/1/start", "10"},
          {"/emitters/2/start", "10"},
          {"/duration", "0.35"}};
}

double mean_speed(const Report& report, double from, double to) {
  double sum = 0;
  int frames = 0;
  for (const FrameMeasure& frame : report.frames) {
    if (frame.time < from || frame.time > to) continue;
    sum += std::sqrt(2 * frame.kinetic_energy / frame.mass);
    ++frames;
  }
  return sum / frames;
}

void expect_balance(const Report& report) {
  for (const FrameMeasure& f : report.frames) {
    EXPECT_EQ(f.points_emitted + f.points_inserted,
              f.points + f.points_left + f.points_merged + f.points_removed);
    // Shares of mass add up exactly; what differs is the rounding of sums over many points.
    EXPECT_NEAR(f.mass + f.mass_left, f.mass_emitted, 1e-12 * f.mass_emitted);
  }
}

}  // namespace lather::testing_support
