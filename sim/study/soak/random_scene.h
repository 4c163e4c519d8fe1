#pragma once

#include <cstdint>
#include <string>

#include "sim/scene/scene.h"

/// Scenes drawn at random over everything that a scene may hold.
namespace lather::study {

/// A scene that the program takes, as a document and as it was read.
struct RandomScene {
  std::string document;  ///< JSON; a mesh in it is named "mesh.obj"
  Scene scene;
  int refusals = 0;  ///< how often what was drawn had to be changed before it was taken
};

/// The bytes of "mesh.obj".
[[nodiscard]] const char* random_scene_mesh();

/// Few points in a domain of at most 14 spacings each way, a handful of frames in `most_steps` planned steps
/// at most, of all the rest whatever the schema allows. The
/// same for the same seed and index. What the program refuses in a drawn document is taken out, by the
/// pointers of its errors; where nothing is left of it another one is drawn. Throws std::logic_error when a
/// hundred documents led to no scene.
[[nodiscard]] RandomScene random_scene(std::uint64_t seed, std::uint64_t index, std::uint64_t most_steps);

}  // namespace lather::study
