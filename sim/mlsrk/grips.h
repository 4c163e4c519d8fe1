#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::mlsrk {

/// Where grips take their points in a step. Const after place(): safe to share between threads.
///
/// A step takes a point from x to T(t + dt) T(t)^-1 x, T being the motion's placement: it lands on the path
/// itself, however long the step, and nothing adds up but the rounding of positions, which has no bias.
class Grips {
 public:
  explicit Grips(const Scene& scene);

  /// For the step that starts at `time` and is `dt` long, s.
  void place(double time, double dt);

  [[nodiscard]] bool none() const { return all_.empty(); }

  /// Is a point of this entry of Field::kGrip driven in the step?
  [[nodiscard]] bool drives(std::uint32_t entry) const { return entry != 0 && steps_[entry - 1].active; }
  /// The mean velocity over the step of a driven point that is at `x` (m), m/s.
  [[nodiscard]] Vec3 velocity(std::uint32_t entry, const Vec3& x) const {
    return steps_[entry - 1].velocity(x);
  }

  /// Largest speed of points that were in their grips' reach at the start, in a step from `time`, `dt` long,
  /// m/s: for the length of a step in which a grip sets in, when no point moves with it yet.
  [[nodiscard]] double fastest(double time, double dt) const;

 private:
  /// A ball around all points that a grip can take.
  struct Reach {
    Vec3 middle;
    double radius;
  };
  /// What a grip does in one step.
  struct Step {
    bool active = false;
    Mat3 gradient = Mat3::Zero();  // of the mean velocity, 1/s
    Vec3 at_origin = Vec3::Zero();

    [[nodiscard]] Vec3 velocity(const Vec3& x) const { return gradient * x + at_origin; }
  };
  static Step step_of(const Grip& grip, double time, double dt);
  static Reach reach_of(const Scene& scene, const Grip& grip);

  std::vector<Grip> all_;
  std::vector<Reach> reaches_;
  std::vector<Step> steps_;
};

}  // namespace lather::mlsrk
