#pragma once

#include <vector>

#include "sim/simulation.h"

namespace lather::study {

/// What equally spaced samples of a decaying oscillation about 0 show.
struct Oscillation {
  double period = 0;           ///< in intervals of the samples, from its zeros
  double loss_per_period = 0;  ///< of the amplitude, dimensionless, from its peaks
};

/// Needs two zeros and two peaks at least; each is found between samples, by a line and by a parabola.
[[nodiscard]] Oscillation oscillation_of(const std::vector<double>& samples);

/// The part of the points' velocity field that a wave along `axis` has in a box of length 1 m, 2 <v_x sin(2
/// pi x_axis)>, m/s.
[[nodiscard]] double wave_amplitude(const Simulation& simulation, int axis);

}  // namespace lather::study
