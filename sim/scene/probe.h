#pragma once

#include <optional>
#include <string>
#include <variant>

#include "sim/math/vec.h"

namespace lather {

/// What material does to an obstacle: force and torque.
struct ForceProbe {
  std::string obstacle;
  std::optional<Vec3>
      about;  ///< m, where the scene puts the obstacle; moves with it. None: the shape's origin
};
/// The same for all faces of the domain together.
struct WallProbe {
  Vec3 about = Vec3::Zero();  ///< m
};
/// The state of the material around a place.
struct PointProbe {
  Vec3 at = Vec3::Zero();  ///< m
  std::string obstacle;    ///< moves with it; "": fixed
};
/// What goes through a plane, a disc or a rectangle, and what is above it.
struct PlaneProbe {
  Vec3 point = Vec3::Zero();      ///< m; centre of the disc or rectangle
  Vec3 normal = Vec3::UnitY();    ///< of any length; flux along it is positive
  double radius = 0;              ///< m, of the disc; 0: none
  std::optional<Vec3> along;      ///< direction of the rectangle's first edge
  Eigen::Vector2d size = {0, 0};  ///< m, of the rectangle, along `along` and across; 0: none
};

struct Probe {
  std::string name;
  double interval = 0;  ///< s, between samples; 0: that of frames
  std::variant<ForceProbe, WallProbe, PointProbe, PlaneProbe> kind;
};

}  // namespace lather
