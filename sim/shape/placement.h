#pragma once

#include "sim/math/vec.h"

namespace lather {

/// The rotation about x, then y, then z (fixed axes), angles in degrees: R = Rz Ry Rx.
[[nodiscard]] Mat3 rotation_of(const Vec3& rotate_deg);

[[nodiscard]] double radians(double degrees);

}  // namespace lather
