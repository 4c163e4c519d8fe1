#pragma once

#include <vector>

#include "sim/particles/particle_set.h"
#include "sim/plan/plan.h"
#include "sim/scenery.h"

namespace lather {

/// Makes frames from points.
class Snapshot {
 public:
  explicit Snapshot(const Scene& scene) : scenery_(scene) {}

  /// `sets[m]` are material m's points at `time` (s).
  template <class Real>
  [[nodiscard]] Frame take(const std::vector<ParticleSet<Real>>& sets, double time, const Plan& plan,
                           int index) const;

 private:
  Scenery scenery_;
};

}  // namespace lather
