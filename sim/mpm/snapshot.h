#pragma once

#include "sim/mpm/step.h"
#include "sim/scenery.h"

namespace lather::mpm {

/// Makes frames from states.
class Snapshot {
 public:
  explicit Snapshot(const Scene& scene) : scenery_(scene) {}

  template <class Real>
  [[nodiscard]] Frame take(const State<Real>& state, const Plan& plan, int index) const;

 private:
  Scenery scenery_;
};

}  // namespace lather::mpm
