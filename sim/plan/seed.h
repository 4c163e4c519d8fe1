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
  std::uint32_t grip = 0;  ///< 1 + index into Scene::grips; 0: free
};

/// Distance of neighbouring points of the initial lattice, m.
[[nodiscard]] double point_distance(const Scene& scene);

/// One release of an emitter: a copy of its shape, or what streams into the shape.
struct Release {
  std::size_t emitter = 0;
  std::uint64_t number = 0;   ///< from 0, of this emitter
  Vec3 shift = Vec3::Zero();  ///< m, that the stream's lattice has moved
  Vec3 sweep = Vec3::Zero();  ///< m, that the stream has moved since the last layer
  bool layer = false;         ///< only the points that were outside the shape one sweep ago

  [[nodiscard]] static Release copy_of(std::size_t emitter, std::uint64_t number) {
    return {emitter, number, Vec3::Zero(), Vec3::Zero(), false};
  }
};

/// Points of a scene per material.
struct PointCounts {
  std::vector<std::uint64_t> at_start;
  std::vector<std::uint64_t> emitted;  ///< over the run, if no release has to wait; of streams, to a layer
};

/// Fills the bodies with a regular lattice of points, `points_per_cell` to a cell, jittered by the scene's
/// `jitter` with counter-based random numbers keyed by seed and lattice place. A place that two bodies cover
/// goes to the earlier one. Calls visit(seed) in a fixed order. Throws InputError when a body gets no point,
/// or the scene has none. The material of a point of a mixture is a counter-based random number too.
void seed_points(const Scene& scene, const std::function<void(const Seed&)>& visit);

/// The same for the points of one release; ids count from 0.
void seed_release(const Scene& scene, const Release& release, const std::function<void(const Seed&)>& visit);

/// Time in which a stream moves by one distance of points, s.
[[nodiscard]] double layer_interval(const Scene& scene, const Emitter& emitter);

/// Counts without making all points at once. Throws InputError when a body, an emitter or a grip gets no
/// point.
[[nodiscard]] PointCounts count_points(const Scene& scene);

}  // namespace lather
