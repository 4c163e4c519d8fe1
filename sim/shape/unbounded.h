#pragma once

#include "sim/shape/shape.h"

namespace lather {

/// Does the shape reach to infinity, as far as its kind tells (an intersection of planes counts as
/// unbounded)?
[[nodiscard]] bool is_unbounded(const Shape& shape);

/// The axis-aligned box around linear * box + translation.
[[nodiscard]] Box3 transformed(const Box3& box, const Mat3& linear, const Vec3& translation);

}  // namespace lather
