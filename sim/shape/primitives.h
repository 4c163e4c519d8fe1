#pragma once

#include "sim/shape/shape.h"

/// Exact signed distances of the primitives in their own frame, metres. Used by distance() and tested alone.
namespace lather::primitive {

[[nodiscard]] double distance(const SphereShape& s, const Vec3& x);
[[nodiscard]] double distance(const BoxShape& s, const Vec3& x);
[[nodiscard]] double distance(const CylinderShape& s, const Vec3& x);
[[nodiscard]] double distance(const CapsuleShape& s, const Vec3& x);
[[nodiscard]] double distance(const ConeShape& s, const Vec3& x);
[[nodiscard]] double distance(const TorusShape& s, const Vec3& x);
[[nodiscard]] double distance(const EllipsoidShape& s, const Vec3& x);
[[nodiscard]] double distance(const PlaneShape& s, const Vec3& x);
[[nodiscard]] double distance(const RevolutionShape& s, const Vec3& x);

/// Never more than the distance, and cheap to have; -infinity inside.
[[nodiscard]] double least_distance(const EllipsoidShape& s, const Vec3& x);

}  // namespace lather::primitive
