#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lather {

/// A point, direction or velocity in world space; SI units, y up. 2D scenes leave z at 0.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// An axis-aligned box in world space, metres.
struct Box3 {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  [[nodiscard]] Vec3 center() const { return 0.5 * (min + max); }
  [[nodiscard]] Vec3 extent() const { return max - min; }
  void include(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

}  // namespace lather
