#pragma once

#include <string>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// A ball of shaving cream that does not tear (radius 0.1 m, cells of 25 mm) in free space, as JSON; tests
/// change it by overrides.
std::string ball_scene();

/// Runs all frames of a scene and returns the report.
Report run(const std::string& scene_json, const std::vector<Override>& overrides = {}, int threads = 1,
           KernelLevel level = best_kernel_level());

/// Checkpoints of the states after each of the first `count` steps from frame `frame` on; a run that is
/// restored from any of them must have a last frame that is bit-equal to that of the run that went on.
void expect_bit_equal_after_restore(const Plan& plan, int frame, int count);

}  // namespace lather::testing_support
