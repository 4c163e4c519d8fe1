#pragma once

#include <string>
#include <vector>

#include "server/command/commands.h"
#include "sim/scene/scene.h"

namespace lather::server {

/// The file's text. Throws InputError when it cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// "/pointer=value" each. Throws InputError for one without '='.
[[nodiscard]] std::vector<Override> read_overrides(const std::vector<std::string>& set);

/// Meshes by their paths from the directory of the scene's file.
[[nodiscard]] MeshSource meshes_beside(const std::filesystem::path& scene_file);

[[nodiscard]] Scene read_scene(const SceneSource& source);

/// One of several scenes, at their size where it names one of that name.
[[nodiscard]] Scene scene_of(const ScenesOptions& options, const std::filesystem::path& file);

/// For people: each problem with its place, its value and what is allowed.
void print_problems(const std::string& what, const std::vector<Problem>& problems);

}  // namespace lather::server
