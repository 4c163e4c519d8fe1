#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// What becomes of the body "ball" on the body "layer" and below it.
struct Roll {
  /// Snow of the layer that rides on the ball above its middle, over the ball's own mass: after each third of
  /// the time until the ball comes to the slope's end.
  std::array<double, 3> grown{};
  double whole = 0;        ///< share of the ball's own points in its largest piece then
  std::size_t pieces = 0;  ///< at the end of the run, of what rolled: ball and snow on it
  double largest = 0;      ///< share of the largest of them
};

/// Pieces are points joined by chains of neighbours that stayed neighbours: no more than 1.5 spacings apart
/// at first (at the start for the ball, as it leaves the slope for all that rolls) and 2 in the end, so that
/// debris which comes to lie on debris counts as broken off. Of those at the end the ones count that hold 2 %
/// or more. Snow rides within 2.2 radii of the ball's middle.
[[nodiscard]] Roll run_roll(const std::string& size, const std::vector<Override>& overrides, int threads);

}  // namespace lather::testing_support
