#pragma once

// Distances of many places from the nearest of a few points. Compiled per kernel level.

#include "sim/math/lane.h"
#include "sim/mpm/kernels.h"

namespace lather::LATHER_LEVEL {

/// See NearestKernel.
inline void nearest(const float* place, int count, const mpm::PointRows& points, float enough,
                    float* squared) {
  using T = Lane<float>;
  for (int first = 0; first < count; first += kLanes) {
    const T x = T::load(place + first);
    const T y = T::load(place + count + first);
    const T z = T::load(place + 2 * count + first);
    T least = T::load(squared + first);
    for (int r = 0; r < points.rows; ++r) {
      for (std::uint32_t p = points.row[r][0]; p < points.row[r][1]; ++p) {
        const float* at = points.x + 3 * static_cast<std::size_t>(p);
        const T dx = x - at[0];
        const T dy = y - at[1];
        const T dz = z - at[2];
        least = min(dx * dx + dy * dy + dz * dz, least);
      }
      if (!any(least >= T(enough))) break;
    }
    least.store(squared + first);
  }
}

}  // namespace lather::LATHER_LEVEL
