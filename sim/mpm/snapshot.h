#pragma once

#include <memory>
#include <vector>

#include "sim/frame.h"
#include "sim/mpm/step.h"

namespace lather::mpm {

/// Makes frames from states; keeps the obstacles' meshes, which all frames share.
class Snapshot {
 public:
  explicit Snapshot(const Scene& scene);

  template <class Real>
  [[nodiscard]] Frame take(const State<Real>& state, const Plan& plan, int index) const;

 private:
  std::vector<std::shared_ptr<const TriangleMesh>> meshes_;  // null: not visible, or drawn as the floor
  double floor_height_;
};

}  // namespace lather::mpm
