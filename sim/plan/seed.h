#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/scene/scene.h"

namespace lather {

/// One point of the initial state.
struct Seed {
  std::uint32_t material = 0;  ///< index into Scene::materials
  std::uint32_t id = 0;        ///< counts up over all bodies
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Mat3 velocity_gradient = Mat3::Zero();
};

/// Distance of neighbouring points of the initial lattice, m.
[[nodiscard]] double point_distance(const Scene& scene);

/// Fills the bodies with a regular lattice of points, `points_per_cell` to a cell, jittered by the scene's
/// `jitter` with counter-based random numbers keyed by seed and lattice place. A place that two bodies cover
/// goes to the earlier one. Calls visit(seed) in a fixed order. Throws InputError when a body gets no point,
/// or the scene has none.
void seed_points(const Scene& scene, const std::function<void(const Seed&)>& visit);

/// Points per material, without making them all at once.
[[nodiscard]] std::vector<std::uint64_t> count_points(const Scene& scene);

}  // namespace lather
