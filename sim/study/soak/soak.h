#pragma once

#include <cstdint>
#include <string>

#include "sim/study/soak/random_scene.h"
#include "sim/study/stability/invariants.h"

/// Random scenes, each held against what no scene may break.
namespace lather::study {

struct Soaked {
  RandomScene scene;
  Verdict verdict;
};

/// Draws a scene of about `most_steps` steps at most and examines it: every frame sound (see unsoundness());
/// the scene written out reads back as itself; and its points the same, bit for bit, where it runs with two
/// threads and is saved and restored at every frame.
[[nodiscard]] Soaked soak(std::uint64_t seed, std::uint64_t index, std::uint64_t most_steps);

}  // namespace lather::study
