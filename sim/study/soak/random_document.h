#pragma once

#include <cstdint>

#include "sim/math/vec.h"
#include "sim/scene/value.h"

/// Documents drawn at random from a JSON Schema as the descriptor tables make it.
namespace lather::study {

/// Where and how long a scene takes place, so that what is drawn lies within it and lasts as long.
struct Surroundings {
  int dimension = 3;
  Vec3 corner = Vec3::Zero();  ///< of the domain, with the least coordinates, m
  Vec3 size = Vec3::Ones();    ///< of the domain, m
  double spacing = 0.1;        ///< m
  double duration = 1;         ///< s
};

/// A value of the schema `scene`, an object, the same for the same seed and index. Fields that need not be
/// there are there in a third of the documents; numbers are of the order of the surroundings where their
/// unit is one of length, time or both, else of the order of their default or of what is usual in their
/// unit, and one in fifty is an end of its range. What no schema says, such as which names there are to refer
/// to, it may get wrong.
[[nodiscard]] Value random_document(const Value& scene, const Surroundings& surroundings, std::uint64_t seed,
                                    std::uint64_t index);

}  // namespace lather::study
