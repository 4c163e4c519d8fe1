#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::testing_support {

/// What changes the pachinko scene into one penguin that falls on the left pad: lands after 0.07 s, and after
/// 0.35 s it is still above the first row of pins.
[[nodiscard]] std::vector<Override> one_penguin(const std::string& material);

/// Root mean square speed of the material (m/s), mean over the frames between two times (s).
[[nodiscard]] double mean_speed(const Report& report, double from, double to);

/// Every point and all mass that came in is there or has left, in every frame.
void expect_balance(const Report& report);

}  // namespace lather::testing_support
