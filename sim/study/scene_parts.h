#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

/// Words for the scenes of studies, which are made in code: their sizes follow from what they measure, beyond
/// the ranges of scene files.
namespace lather::study {

/// A box with its centre at `center`, m.
[[nodiscard]] ShapePtr box_at(const Vec3& center, const Vec3& size);

[[nodiscard]] Material material_of(const Law& law);

/// A weightless scene of the MLSRK solver in double precision with points `spacing` (m) apart, in 2D.
[[nodiscard]] Scene particle_scene(const std::string& name, double spacing, const Law& law);

/// A body of the scene's first material.
[[nodiscard]] Body body_of(const Scene& scene, const ShapePtr& shape, const Vec3& velocity = Vec3::Zero());

/// Sets duration and frame rate for `frames` equal intervals in `time` (s).
void set_frames(Scene& scene, double time, int frames);

/// Fills `region`, along `axis` a whole number of point distances from the domain's lower corner, with bodies
/// one point thick across `axis`, each with the velocity that `velocity` gives for its coordinate (m) along
/// that axis: initial velocities that a body's own fields cannot say.
void add_layers(Scene& scene, const Box3& region, int axis, const std::function<Vec3(double)>& velocity);

/// Steps on to frame `index`.
void run_to(Simulation& simulation, int index);

}  // namespace lather::study
