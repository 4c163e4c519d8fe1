#pragma once

// What solids with a multiplicative plastic part, F = F_e F_p [MLSRK eq. 24], have in common. Compiled per
// kernel level.

#include "sim/math/tensor.h"

namespace lather::LATHER_LEVEL {

/// What such a law keeps per point. In 2D the z parts of G are 0.
template <class T>
struct ElastoplasticState {
  Mat3<T> deformation;  ///< G = F_e - I
  T plastic_volume;     ///< J_p - 1, J_p = det F_p
};

/// Factor on Lamé's parameters, so on the elastic stress: exp(xi (1 - J_p)). [MLSRK eq. 25]
template <class T, class Real>
inline T hardening(const T& plastic_volume, Real xi) {
  return exp(plastic_volume * Real(-xi));
}

}  // namespace lather::LATHER_LEVEL
