#pragma once

#include <string>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::testing_support {

/// The uniform s'more: foam above the holes while the cracker presses, one thin neck as it is lifted, which
/// tears, and the peak that stays; foam and peak higher than stated for as long as stated. See smore.cpp for
/// the numbers.
void expect_foam_through_holes_and_a_peak(const Scene& scene, int threads);

/// The shell around the core of the toasted s'more.
struct Crust {
  double weak = 0;     ///< share of the shell's points that are torn
  double outside = 0;  ///< share of the core's points that are farther from the axis than all of the shell in
                       ///< their 5 degrees around it: there the shell has opened down to its ends
};

/// `scene` gives its frames the scalar "weak"; its materials are the core and the shell.
[[nodiscard]] Crust find_crust(const Simulation& simulation);

/// The shell tears before the core comes out, and the core does come out.
void expect_crust_tears_before_core_flows(Scene scene, int threads);

}  // namespace lather::testing_support
