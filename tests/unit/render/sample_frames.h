#pragma once

#include <memory>

#include "sim/frame.h"

/// Frames with known content, for tests and pictures.
namespace lather::render {

/// A domain of 1 x 0.6 x 1 m over the floor, one material, no points.
[[nodiscard]] Frame empty_frame();

/// About `count` points in the shape of a dollop of foam: turns of a rope that narrow upwards, resting on the
/// floor.
[[nodiscard]] Frame dollop(int count);

/// A box around the origin, flat faces.
[[nodiscard]] std::shared_ptr<const TriangleMesh> box_mesh(const Vec3& half_sides);

/// The dollop, and a block pressed slanted into its top.
[[nodiscard]] Frame dollop_under_block(int count);

/// A 2D frame of 2 x 1 m with one point at (x, y).
[[nodiscard]] Frame flat_frame(float x, float y, double point_radius);

void add_point(Frame& frame, const Vec3& position, const Vec3& velocity = Vec3::Zero());

}  // namespace lather::render
