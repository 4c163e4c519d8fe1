#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

/// Scenes with one feature each, and the same without: what is not asked for must cost nothing.
namespace lather::testing_support {

struct FeatureScene {
  std::string name;
  std::string minimal;              ///< a scene that never heard of the feature, JSON
  std::vector<Override> with;       ///< puts the feature in
  std::vector<Override> absent;     ///< then takes its parameters away, or says "none" aloud
  std::vector<std::string> fields;  ///< that points carry with it alone
  std::vector<std::string> stages;  ///< that run with it alone
};

/// Tearing, recovery, removal, resampling, phases, swelling, viscosity, hardening, periodic axes, moving
/// obstacles, skin.
[[nodiscard]] const std::vector<FeatureScene>& feature_scenes();

[[nodiscard]] Scene minimal_scene(const FeatureScene& feature);
[[nodiscard]] Scene scene_with(const FeatureScene& feature);
[[nodiscard]] Scene scene_without(const FeatureScene& feature);

}  // namespace lather::testing_support
