#include "sim/study/verify/oscillation.h"

#include <cmath>
#include <numbers>

namespace lather::study {

Oscillation oscillation_of(const std::vector<double>& samples) {
  std::vector<double> zeros;  // intervals
  std::vector<double> peaks;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double before = samples[i - 1];
    const double now = samples[i];
    if (before * now < 0) zeros.push_back(static_cast<double>(i) - now / (now - before));
    const double below = std::abs(before);
    const double here = std::abs(now);
    const double above = std::abs(samples[i + 1]);
    if (here >= below && here > above)  // the top of the parabola through three samples
      peaks.push_back(here + (above - below) * (above - below) / (8 * (2 * here - above - below)));
  }
  Oscillation o;
  o.period = 2 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
  o.loss_per_period = 1 - std::pow(peaks.back() / peaks.front(), 2.0 / static_cast<double>(peaks.size() - 1));
  return o;
}

double wave_amplitude(const Simulation& simulation, int axis) {
  double sum = 0;
  double count = 0;
  simulation.visit_points([&](const PointState& p) {
    sum += p.velocity.x() * std::sin(2 * std::numbers::pi * p.position[axis]);
    ++count;
  });
  return 2 * sum / count;
}

}  // namespace lather::study
