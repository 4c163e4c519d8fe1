#include "sim/shape/placement.h"

#include <cmath>

namespace lather {

double radians(double degrees) {
  return degrees * (M_PI / 180);
}

Mat3 rotation_of(const Vec3& rotate_deg) {
  const double cx = std::cos(radians(rotate_deg.x())), sx = std::sin(radians(rotate_deg.x()));
  const double cy = std::cos(radians(rotate_deg.y())), sy = std::sin(radians(rotate_deg.y()));
  const double cz = std::cos(radians(rotate_deg.z())), sz = std::sin(radians(rotate_deg.z()));
  Mat3 r;
  r << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
      sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,   //
      -sy, cy * sx, cy * cx;
  return r;
}

}  // namespace lather
