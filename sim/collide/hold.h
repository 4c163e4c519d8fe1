#pragma once

#include <optional>

#include "sim/math/vec.h"

namespace lather {

/// What contact prescribes of one node's velocity in a step that solves for velocities: the part inside the
/// span of the contact normals, or all of it where the node sticks, is given, the rest is free. Coulomb
/// friction is found between solves, see settle(); of several frictional contacts at one node the first one
/// rubs.
class Hold {
 public:
  /// The whole velocity is `velocity` (m/s): adhesive obstacles, stick walls.
  void all(const Vec3& velocity);

  /// v . normal = velocity . normal, with Coulomb friction mu_f `friction` against `velocity`; if it `sticks`
  /// the whole velocity is prescribed until settle() finds otherwise. A normal in the span of earlier ones
  /// adds nothing.
  void along(const Vec3& normal, const Vec3& velocity, double friction, bool sticks);

  [[nodiscard]] bool any() const { return held_; }

  /// The velocity nearest to `v` that meets the contact.
  [[nodiscard]] Vec3 meet(const Vec3& v) const { return fixed_ + free_ * v; }

  /// The part of a change of velocity, or of an impulse, that the contact leaves free.
  [[nodiscard]] Vec3 project(const Vec3& change) const { return free_ * change; }

  /// A change of what the contact does to a node.
  struct Change {
    Vec3 velocity = Vec3::Zero();  ///< of the node, m/s: it sticks now
    Vec3 friction = Vec3::Zero();  ///< of the friction's impulse over the node's mass, m/s
  };
  /// Given a solved velocity `v` and `push`, the impulse over the node's mass (m/s) with which the contact
  /// must hold it there, changes between sticking (|push across the normal| <= mu_f push . n) and slipping
  /// with friction mu_f push . n against the motion. None where nothing changes; else solve again.
  std::optional<Change> settle(const Vec3& v, const Vec3& push);

 private:
  struct Rub {
    Vec3 normal;
    Vec3 velocity;
    double friction;
    Vec3 fixed;  // of the hold while it slips
    Mat3 free;
    bool sticks = false;
    Vec3 impulse = Vec3::Zero();  // while it slips, over the node's mass
  };
  void stick();

  bool held_ = false;
  Mat3 free_ = Mat3::Identity();
  Vec3 fixed_ = Vec3::Zero();
  std::optional<Rub> rub_;
};

}  // namespace lather
