#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/scene/value.h"
#include "sim/study/stability/covering.h"

/// A block of any material thrown against floor and walls, at the ends of what parameters may be.
namespace lather::study {

struct Factor {
  std::string name;  ///< a JSON pointer into the scene that is set to the level, or a word; see extreme_scene
  std::vector<Value> levels;
};

/// The models of material that the matrix of extremes is made for.
[[nodiscard]] const std::vector<std::string>& extreme_models();

/// What is varied of a model's material, of the step and of the surroundings, under one of the solvers: two
/// or three levels each, the smallest and the largest that make sense and often one between them.
[[nodiscard]] std::vector<Factor> extreme_factors(Solver solver, const std::string& model);

/// The scene of a choice, as a document: a block six spacings wide, one above the floor, flies into a corner
/// of a domain twelve spacings wide for `steps` steps at the planned length, ten frames. Factors by word:
/// "spacing" (m), on which all lengths follow; "gravities", over 9.81 m/s^2, downward; "mach", its velocity
/// over the material's wave speed; "floor", its friction coefficient, or "adhesive"; "shear_over_bulk", of a
/// herschel-bulkley material. Throws InputError where the document is no valid scene.
[[nodiscard]] Value extreme_scene(Solver solver, const std::string& model, const std::vector<Factor>& factors,
                                  const Choice& choice, int steps);

}  // namespace lather::study
