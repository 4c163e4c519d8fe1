#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// What becomes of a biscuit that is dipped and pulled apart, by what its points were when it came out of the
/// water.
struct BrokenBiscuit {
  double wet = 0;         ///< share of its points with c > 0.2 then
  double wet_fallen = 0;  ///< share of those that lie below the hands' lowest place at the end
  double dry_held = 0;    ///< share of the points with c < 0.1 that do not
};
[[nodiscard]] BrokenBiscuit run_biscuit(const std::string& size, const std::vector<Override>& overrides,
                                        int threads);

}  // namespace lather::testing_support
