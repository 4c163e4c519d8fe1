#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::test {

/// A scene with all that must be given and nothing else.
std::string small_scene();

/// The small scene with one value set, given as JSON.
std::string with(const std::string& pointer, const std::string& json);

using Changes = std::vector<std::pair<std::string, std::string>>;
/// A scene of the solver "mlsrk" with a material of every model; with values set, given as JSON.
std::string mlsrk_scene(const Changes& changes = {});

/// The problems of a scene; empty where it is good.
std::vector<Problem> problems_of(const std::string& text, const std::string& size = {},
                                 const std::vector<Override>& overrides = {});

/// Every example scene: file name and text.
std::vector<std::pair<std::string, std::string>> example_scenes();

}  // namespace lather::test
