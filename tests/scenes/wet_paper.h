#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// What becomes of a sheet of paper that is hit by water and pulled at both ends. Its parts are sets of
/// points joined by chains with gaps of at most one and a half spacings.
struct TornPaper {
  double second_part = 0;  ///< share of the paper's points in the second largest part at the end
  double tear_time = 0;    ///< s: when that was first above a tenth; the duration where it never was
  double wetness = 0;  ///< mean c then, beside the tear and in the whole sheet: the former less the latter
};
[[nodiscard]] TornPaper run_wet_paper(const std::string& size, const std::vector<Override>& overrides,
                                      int threads);

}  // namespace lather::testing_support
