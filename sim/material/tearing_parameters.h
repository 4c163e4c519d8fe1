#pragma once

#include <cmath>
#include <limits>

namespace lather {

/// When a foam tears and heals ("Continuum Foam", section 7, Table I).
struct TearingParameters {
  /// sigma_T: a point is weak while its accumulated plasticity |dev C^p|_F exceeds this; dimensionless.
  double tear_threshold = std::numeric_limits<double>::infinity();
  /// eta_p: accumulated plasticity fades in this time, s. Has no effect on a material that cannot tear.
  double recovery_time = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool tears() const { return std::isfinite(tear_threshold); }
  [[nodiscard]] bool recovers() const { return tears() && std::isfinite(recovery_time); }
};

}  // namespace lather
