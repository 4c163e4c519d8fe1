#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// Powder that falls into water and dissolves. The scene's first body is the water, its second the powder.
struct Dissolution {
  double component_drift = 0;  ///< largest change of sum m c over the run, over its value at the start
  double floating = 0;         ///< mean height of the powder less that of the water, over the same for two
                               ///< layers, when the powder has just come to lie on the water
  double dry_first = 0;        ///< share of the powder with c < 0.3 then
  double dry_last = 0;         ///< and at the end
  double shrinkage = 0;       ///< 1 - volume at rest at the end over that at the start, by the density curves
  double full_shrinkage = 0;  ///< what that would be of one concentration throughout
  double volume_error = 0;  ///< covered volume at the end, without its own weight's compression, over that at
                            ///< rest, less 1
};
/// `landed`: time by which the powder lies on the water, s.
[[nodiscard]] Dissolution run_dissolution(const std::string& name, const std::string& size, double landed,
                                          const std::vector<Override>& overrides, int threads);

/// The 2D powder keeps its own mass and that of what dissolves, and takes less room in the end; a balance of
/// the concentration alone loses a share of `lost` at least.
void expect_powder_keeps_its_masses(const std::string& size, double lost, int threads);

/// The starch floats, dissolves, and takes as much room as its density curve says, but for a share of
/// `volume_error`.
void expect_starch_floats_and_dissolves(const std::string& size, double volume_error, int threads);

}  // namespace lather::testing_support
