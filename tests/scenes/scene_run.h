#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// scenes/NAME.json at a size it names ("": as it stands).
Scene scene_file(const std::string& name, const std::string& size,
                 const std::vector<Override>& overrides = {});

/// Names of all files in scenes/, without their ending, in order.
std::vector<std::string> scene_names();

/// Runs all frames, calls `see` at each of them, prints what it cost, and returns the report.
Report run_scene(const Scene& scene, int threads,
                 const std::function<void(int frame, const Simulation&)>& see = {});

}  // namespace lather::testing_support
