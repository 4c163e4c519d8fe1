#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// What a cannonball does to a figure of jelly: the report's pieces at the end, of which the ball, which has
/// left by then, is none; and the momentum along its path that the jelly then has, over the ball's own.
struct Shot {
  std::uint64_t pieces = 0;
  double largest_piece = 0;  ///< share of the points
  double handed_over = 0;
};
[[nodiscard]] Shot run_shot(const std::string& size, const std::vector<Override>& overrides, int threads);

}  // namespace lather::testing_support
