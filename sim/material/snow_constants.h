#pragma once

namespace lather {

/// What the return mapping of snow reads, in the precision of the run. Made by snow_constants().
template <class Real>
struct SnowConstants {
  Real least_log_stretch;    ///< log(1 - theta_c)
  Real largest_log_stretch;  ///< log(1 + theta_s)
  Real hardening;            ///< xi, dimensionless
};

}  // namespace lather
