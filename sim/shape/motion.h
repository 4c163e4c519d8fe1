#pragma once

#include <variant>
#include <vector>

#include "sim/frame.h"
#include "sim/math/vec.h"

namespace lather {

/// Motions of obstacles, relative to where the scene puts them. A motion owns its parameters; SI units.
struct AtRest {};
struct LinearMotion {  ///< moves between `start` and `end`, then stays
  Vec3 velocity = Vec3::Zero();
  double start = 0;   ///< s
  double end = 1e30;  ///< s
};
struct Oscillation {  ///< displacement = direction * amplitude * sin(2 pi frequency (t - start) + phase),
                      ///< from start to end
  Vec3 direction = Vec3::UnitX();  ///< need not be of unit length; is normalised
  double amplitude = 0;            ///< m
  double frequency = 0;            ///< 1/s
  double phase_deg = 0;  ///< the displacement is measured from its value at `start`, so nothing jumps
  double start = 0;      ///< s
  double end = 1e30;     ///< s
};
struct Rotation {  ///< about the axis through `center`
  Vec3 center = Vec3::Zero();
  Vec3 axis = Vec3::UnitY();
  double rate_deg = 0;  ///< degrees per second
  double start = 0;     ///< s
  double end = 1e30;    ///< s
};
struct Keyframe {
  double time = 0;                 ///< s, ascending
  Vec3 translate = Vec3::Zero();   ///< m
  Vec3 rotate_deg = Vec3::Zero();  ///< about the scene's origin, before the shift; x, then y, then z
};
struct Keyframes {  ///< cubic Hermite in between (Catmull-Rom tangents), held before the first and after the
                    ///< last
  std::vector<Keyframe> keys;
};
using Motion = std::variant<AtRest, LinearMotion, Oscillation, Rotation, Keyframes>;

/// Placement of the body at time t (s), relative to its place in the scene. Continuous in t; the identity at
/// t = 0 for every motion but keyframes, which say themselves where they are.
[[nodiscard]] Pose pose_at(const Motion& motion, double t);

/// Velocity of the material point that is at world position `x` at time t, m/s: the derivative of pose_at.
[[nodiscard]] Vec3 velocity_at(const Motion& motion, double t, const Vec3& x);

/// Largest speed of any point within `radius` of `center` over [0, duration], m/s (an upper bound).
[[nodiscard]] double max_speed(const Motion& motion, const Vec3& center, double radius, double duration);

}  // namespace lather
