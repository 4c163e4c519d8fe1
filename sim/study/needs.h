#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/plan/plan.h"

/// What a scene makes the program keep and do, and no more.
namespace lather::study {

struct StageNeed {
  std::string name;             ///< as in the plan
  std::optional<double> share;  ///< of the time in all stages; none: it is a part of the stage before it
};

struct SceneNeeds {
  std::vector<PlannedMaterial> materials;
  std::vector<StageNeed> stages;
  std::vector<std::string> idle;  ///< stages that the trial spent time in though the plan does not name them
};

/// Runs the scene's first steps for about `seconds`. Throws as Simulation does.
[[nodiscard]] SceneNeeds needs_of(const Plan& plan, int threads, double seconds);

}  // namespace lather::study
