#pragma once

// Sums across lanes. Compiled per kernel level, like lane.h.

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// The sum of the values in a T, in a fixed order.
template <class Real>
inline Real total(const Lane<Real>& a) {
  auto all = a.p[0];
  for (int i = 1; i < Lane<Real>::kPackets; ++i) all = all + a.p[i];
  return Eigen::internal::predux(all);
}
inline float total(float a) {
  return a;
}
inline double total(double a) {
  return a;
}

}  // namespace lather::LATHER_LEVEL
